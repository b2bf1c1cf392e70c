// Buffers that shaders reach by address. There are no descriptor sets: a pass gets one address in
// its push constants.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "runtime/gpu/device.h"

namespace nightcity::gpu {

enum class Memory {
  device,  // fast; filled by upload() or by shaders
  host,    // mapped and coherent: what the CPU writes
  // The same for what the CPU reads: in its caches, where the device has such memory. Reading past
  // them takes some ten times as long.
  readback,
};

class Buffer {
 public:
  Buffer() = default;
  /// `bytes` may be 0: such a buffer still has an address, so that shaders need no null checks.
  /// Throws Error, with the bytes that are needed and those that are free, if there is not enough
  /// memory.
  Buffer(Device& device, std::size_t bytes, Memory memory = Memory::device);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  /// Returns a device buffer that holds `values`.
  template <class T>
  static Buffer of(Device& device, std::span<const T> values) {
    Buffer buffer(device, values.size_bytes());
    buffer.upload_first(values.data(), values.size_bytes());
    return buffer;
  }

  std::uint64_t address() const { return address_; }
  std::size_t bytes() const { return bytes_; }
  VkBuffer handle() const { return buffer_; }
  void* mapped() const { return mapped_; }  // null for device memory

  void upload(const void* data, std::size_t bytes, std::size_t offset = 0);
  /// The same before any command has used the buffer: where the host can map the device's memory (a
  /// CPU driver, an integrated device), the bytes are written there at once.
  void upload_first(const void* data, std::size_t bytes, std::size_t offset = 0);
  /// The same for records that are made as they are uploaded: calls `make(to, first)` for pieces
  /// one after the other, so that what is uploaded need not be in memory as a whole. Record `first`
  /// + i belongs to to[i], which may be memory that is slow to read.
  template <class T, class Make>
  void make_first(std::size_t count, Make make) {
    make_pieces(count, sizeof(T), [&](void* to, std::size_t first, std::size_t size) {
      make(std::span<T>(static_cast<T*>(to), size), first);
    });
  }
  /// Returns the memory itself, to be filled before any command has used the buffer, where the host
  /// can map the device's memory; null where it cannot.
  void* map_first();
  void download(void* data, std::size_t bytes, std::size_t offset = 0) const;
  template <class T>
  std::vector<T> read(std::size_t count) const {
    std::vector<T> values(count);
    download(values.data(), count * sizeof(T));
    return values;
  }
  void fill_zero();

 private:
  using MakePiece = std::function<void(void* to, std::size_t first, std::size_t count)>;
  void make_pieces(std::size_t count, std::size_t record_bytes, const MakePiece& make);
  void copy_from(const Buffer& from, const VkBufferCopy& region);
  void release();

  Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::uint64_t address_ = 0;
  std::size_t bytes_ = 0;
  std::uint32_t memory_type_ = 0;
  std::size_t allocated_ = 0;  // bytes that the device counts
  void* mapped_ = nullptr;
};

}  // namespace nightcity::gpu
