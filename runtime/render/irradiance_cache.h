// The irradiance cache of a renderer: its buffers, and the passes that bring it up to date in a
// frame (shaders/irradiance_cache.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/gpu/buffer.h"
#include "runtime/render/frame_run.h"
#include "runtime/render/pass_library.h"
#include "runtime/render/settings.h"

namespace nightcity::render {

class IrradianceCache {
 public:
  explicit IrradianceCache(gpu::Device& device) : device_(device) {}

  /// Forgets everything with the next frame that uses the cache.
  void clear() { forget_ = true; }

  /// Writes the addresses and sizes into `frame`, whose cameras and size are filled in. `moved_s`
  /// is the scene's time since the frame before where its light changes with time, else 0.
  void enter(gpu::Frame& frame, const IndirectSettings& settings, double moved_s,
             std::uint32_t max_paths);

  /// Returns the passes as steps of a frame, between the primary pass and shading. `passes` must
  /// outlive them.
  std::vector<FrameStep> list_steps(const PassSet& passes, std::uint64_t frame_address) const;

  /// Returns the pass after shading that adds what the cache does not hold.
  FrameStep path_step(const PassSet& passes, std::uint64_t frame_address) const;

 private:
  FrameStep list_step(const char* name, const PassSet& passes, std::uint64_t frame_address,
                      std::uint32_t round) const;

  gpu::Device& device_;
  gpu::Buffer cells_, seen_, uncached_;
  std::uint32_t count_ = 0, width_ = 0, height_ = 0;
  bool forget_ = false;
  std::uint32_t rounds_ = 0;  // of paths in this frame
};

}  // namespace nightcity::render
