// Host memory that transfers to and from a device go through.
#pragma once

#include <algorithm>
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

  /// Lets a transfer use the memory alone.
  std::unique_lock<std::mutex> take_turn() { return std::unique_lock(mutex_); }
  /// Returns memory for a piece of a transfer of `bytes`, Memory::host or Memory::readback. Call it
  /// in a turn.
  const Buffer& piece_of(std::size_t bytes, Memory memory) {
    Buffer& kept = memory == Memory::host ? up_ : down_;
    const std::size_t needed = std::min(bytes, piece_bytes);
    if (kept.bytes() < needed) {
      kept = {};
      kept = Buffer(device_, needed, memory);
    }
    return kept;
  }

 private:
  Device& device_;
  std::mutex mutex_;
  Buffer up_, down_;
};

}  // namespace nightcity::gpu
