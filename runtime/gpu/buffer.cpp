#include "runtime/gpu/buffer.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "formats/parallel.h"
#include "formats/touch_pages.h"
#include "runtime/gpu/staging.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {
namespace {
constexpr VkMemoryPropertyFlags device_local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags host_access =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

std::uint32_t choose_type(const Device& device, std::uint32_t allowed, Memory memory) {
  if (memory == Memory::device) return device.memory_type(allowed, device_local);
  return device.memory_type(allowed, host_access,
                            memory == Memory::readback ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT : 0);
}

// Copies what is large by all threads: more than half of the time passes until the system has got
// the pages that are written to.
void copy(void* to, const void* from, std::size_t bytes) {
  constexpr std::size_t piece = std::size_t{1} << 20, min_parallel = 4 * piece;
  run_parallel(
      (bytes + piece - 1) / piece, bytes < min_parallel ? 1 : count_cores(), [&](std::size_t i) {
        const std::span target(static_cast<std::byte*>(to) + i * piece,
                               std::min(piece, bytes - i * piece));
        touch_pages(target);
        std::memcpy(target.data(), static_cast<const std::byte*>(from) + i * piece, target.size());
      });
}
}  // namespace

Buffer::Buffer(Device& device, std::size_t bytes, Memory memory) : device_(&device), bytes_(bytes) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = std::max<std::size_t>(bytes, 16);
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
               VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  if (device.trace() != Trace::compute)
    info.usage |= VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                  VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
  if (device.trace() == Trace::pipeline) info.usage |= VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR;
  VK_CHECK(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_));
  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(device.handle(), buffer_, &requirements);

  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate.pNext = &flags;
  allocate.allocationSize = requirements.size;
  try {
    memory_type_ = choose_type(device, requirements.memoryTypeBits, memory);
    allocate.memoryTypeIndex = memory_type_;
    device.take_memory(memory_type_, requirements.size);
    allocated_ = requirements.size;
    const VkResult result = vkAllocateMemory(device.handle(), &allocate, nullptr, &memory_);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
      device.refuse_memory(memory_type_, requirements.size);
    check(result, "vkAllocateMemory");
    VK_CHECK(vkBindBufferMemory(device.handle(), buffer_, memory_, 0));
    if (memory != Memory::device)
      VK_CHECK(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_));
  } catch (...) {
    release();
    throw;
  }
  VkBufferDeviceAddressInfo address{};
  address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  address.buffer = buffer_;
  address_ = vkGetBufferDeviceAddress(device.handle(), &address);
}

Buffer::~Buffer() {
  release();
}

Buffer::Buffer(Buffer&& other) noexcept {
  *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(address_, other.address_);
  std::swap(bytes_, other.bytes_);
  std::swap(memory_type_, other.memory_type_);
  std::swap(allocated_, other.allocated_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

void Buffer::release() {
  if (!device_) return;
  vkDestroyBuffer(device_->handle(), buffer_, nullptr);
  vkFreeMemory(device_->handle(), memory_, nullptr);
  device_->give_memory_back(allocated_);
  allocated_ = 0;
  buffer_ = VK_NULL_HANDLE;
  memory_ = VK_NULL_HANDLE;
}

void Buffer::upload(const void* data, std::size_t bytes, std::size_t offset) {
  if (bytes == 0) return;
  if (mapped_) {
    std::memcpy(static_cast<char*>(mapped_) + offset, data, bytes);
    return;
  }
  for (std::size_t done = 0; done < bytes; done += Staging::piece_bytes) {
    const std::size_t piece = std::min(Staging::piece_bytes, bytes - done);
    device_->staging().use_piece(piece, Memory::host, [&](const Buffer& staging) {
      copy(staging.mapped(), static_cast<const char*>(data) + done, piece);
      copy_from(staging, {0, offset + done, piece});
    });
  }
}

void Buffer::copy_from(const Buffer& from, const VkBufferCopy& region) {
  device_->run([&](VkCommandBuffer commands) {
    vkCmdCopyBuffer(commands, from.buffer_, buffer_, 1, &region);
    full_barrier(commands);
  });
}

void Buffer::upload_first(const void* data, std::size_t bytes, std::size_t offset) {
  if (bytes == 0) return;
  if (mapped_ || !device_->has(memory_type_, host_access)) return upload(data, bytes, offset);
  void* target = nullptr;
  VK_CHECK(vkMapMemory(device_->handle(), memory_, offset, bytes, 0, &target));
  copy(target, data, bytes);
  vkUnmapMemory(device_->handle(), memory_);
}

void* Buffer::map_first() {
  if (mapped_ || !device_->has(memory_type_, host_access)) return mapped_;
  void* memory = nullptr;  // stays mapped until it is freed
  VK_CHECK(vkMapMemory(device_->handle(), memory_, 0, VK_WHOLE_SIZE, 0, &memory));
  return memory;
}

void Buffer::make_pieces(std::size_t count, std::size_t record_bytes, const MakePiece& make) {
  if (count == 0) return;
  const std::size_t most = Staging::piece_bytes / record_bytes;
  const bool is_mapped = mapped_ || device_->has(memory_type_, host_access);
  void* target = mapped_;
  if (is_mapped && !mapped_)
    VK_CHECK(vkMapMemory(device_->handle(), memory_, 0, VK_WHOLE_SIZE, 0, &target));
  for (std::size_t first = 0; first < count; first += most) {
    const std::size_t size = std::min(most, count - first), at = first * record_bytes;
    if (is_mapped) {
      make(static_cast<char*>(target) + at, first, size);
      continue;
    }
    device_->staging().use_piece(size * record_bytes, Memory::host, [&](const Buffer& staging) {
      make(staging.mapped(), first, size);
      copy_from(staging, {0, at, size * record_bytes});
    });
  }
  if (is_mapped && !mapped_) vkUnmapMemory(device_->handle(), memory_);
}

void Buffer::download(void* data, std::size_t bytes, std::size_t offset) const {
  if (bytes == 0) return;
  if (mapped_) {
    std::memcpy(data, static_cast<const char*>(mapped_) + offset, bytes);
    return;
  }
  for (std::size_t done = 0; done < bytes; done += Staging::piece_bytes) {
    const std::size_t piece = std::min(Staging::piece_bytes, bytes - done);
    device_->staging().use_piece(piece, Memory::readback, [&](Buffer& staging) {
      staging.copy_from(*this, {offset + done, 0, piece});
      std::memcpy(static_cast<char*>(data) + done, staging.mapped(), piece);
    });
  }
}

void Buffer::fill_zero() {
  device_->run([&](VkCommandBuffer commands) {
    vkCmdFillBuffer(commands, buffer_, 0, VK_WHOLE_SIZE, 0);
    full_barrier(commands);
  });
}

}  // namespace nightcity::gpu
