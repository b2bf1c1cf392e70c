// Host memory that transfers to and from a device go through.
#pragma once

#include <cstddef>
#include <mutex>

#include "runtime/gpu/buffer.h"

namespace nightcity::gpu {

/// Transfers go in pieces, so that a whole city need not lie in host-visible memory a second time.
/// The memory of a piece is kept: a driver takes longer to find it than to copy it.
class Staging {
 public:
  static constexpr std::size_t piece_bytes = std::size_t{16} << 20;

  explicit Staging(Device& device) : device_(device) {}

  /// Calls use(memory) with at least `bytes`, up to piece_bytes, of Memory::host or
  /// Memory::readback. Threads take turns, a piece each: one that uploads a city keeps no other
  /// waiting for all of it.
  template <class Use>
  void use_piece(std::size_t bytes, Memory memory, Use use) {
    Side& side = memory == Memory::host ? up_ : down_;
    const std::lock_guard turn(side.mutex);
    if (side.kept.bytes() < bytes) {
      side.kept = {};
      side.kept = Buffer(device_, bytes, memory);
    }
    use(side.kept);
  }

 private:
  struct Side {
    std::mutex mutex;
    Buffer kept;
  };

  Device& device_;
  Side up_, down_;
};

}  // namespace nightcity::gpu
