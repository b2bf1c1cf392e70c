// The compiled passes, by specialization constants. A driver takes up to a second to compile them,
// so renderers of one device share them, and switching back to an estimator costs nothing.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "runtime/gpu/device.h"
#include "runtime/render/pass_set.h"

namespace nightcity::render {

/// Threads may ask for sets at once; passes of the display and of measurements are one thread's.
class PassLibrary {
 public:
  /// The device must outlive the library. `kept`: so many sets of passes, those that were asked for
  /// last, stay compiled although nobody holds them: on a CPU driver each takes some 70 MB, and as
  /// many are needed by turns where settings are compared.
  explicit PassLibrary(gpu::Device& device, std::size_t kept = SIZE_MAX)
      : device_(device), kept_(kept) {}

  /// Returns the passes for these constants, compiled where they are not kept. Who uses the result
  /// on the device holds it until the device is done.
  std::shared_ptr<const PassSet> get(const PassConstants& constants, Extent extent = Extent::whole);
  /// Returns whether these passes are compiled. If not, starts to compile them in the background,
  /// one set at a time.
  bool is_ready(const PassConstants& constants, Extent extent = Extent::whole);
  /// Returns whether these passes are compiled, and compiles nothing.
  bool has(const PassConstants& constants);
  const gpu::Device& device() const { return device_; }
  /// Returns whether the device translates passes, so that it keeps others waiting.
  bool is_busy() const { return is_busy_; }
  const TracePass& upward(const PassConstants& constants);
  /// The same for a list of rays: for their closest hits, or whether they have any.
  const TracePass& rays(const PassConstants& constants, bool any_hit);
  /// The same for the passes of the display. Only the display's constants may differ from 0.
  const DisplayPasses& display(const PassConstants& constants);

 private:
  struct Kept {
    std::shared_ptr<const PassSet> set;
    std::uint64_t asked = 0;  // when, in calls
  };
  using Key = std::pair<PassConstants, Extent>;
  // Returns the set that is kept under this key, null without one.
  std::shared_ptr<const PassSet> find(const Key& key);
  std::shared_ptr<const PassSet> keep(const Key& key, PassSet set);
  // Returns the set of a draft that has passes in common with a set, null without one.
  std::shared_ptr<const PassSet> find_draft(const Key& key);
  PassSet make_set(const Key& key, const std::shared_ptr<const PassSet>& draft);
  // Keeps a set that was compiled in the background, if one is complete.
  void collect();
  void translate(const PassSet& set, const PassConstants& constants);

  gpu::Device& device_;
  std::size_t kept_;
  std::mutex mutex_;  // of the sets and of what is compiled in the background
  std::map<Key, Kept> sets_;
  std::uint64_t asked_ = 0;  // calls
  std::map<PassConstants, TracePass> upward_;
  std::map<std::pair<PassConstants, bool>, TracePass> rays_;
  std::map<PassConstants, DisplayPasses> display_;
  std::atomic<bool> is_busy_ = false;
  Key next_{};                // compiled in the background,
  std::future<PassSet> set_;  // if this is valid; it uses the device, so it is destroyed first
};

}  // namespace nightcity::render
