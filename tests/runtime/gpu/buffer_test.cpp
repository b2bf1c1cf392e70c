#include "runtime/gpu/buffer.h"

#include <gtest/gtest.h>

#include <numeric>

#include "formats/error.h"
#include "support/gpu.h"

namespace nightcity::test {
namespace {

TEST(Device, ThereIsOneAndItIsUsable) {
  const auto devices = gpu::list_devices();
  ASSERT_FALSE(devices.empty());
  EXPECT_TRUE(test_device().info().usable);
}

TEST(Device, ANameThatNoDeviceHasIsAUsageError) {
  gpu::Device::Options options;
  options.select = "no such device";
  EXPECT_THROW(gpu::Device{options}, UsageError);
}

// A transfer of more than one piece, with an offset.
TEST(Buffer, UploadsAndDownloadsInPieces) {
  std::vector<std::uint32_t> values((std::size_t{70} << 20) / 4);
  std::iota(values.begin(), values.end(), 0u);
  gpu::Buffer buffer(test_device(), values.size() * 4 + 16);
  buffer.upload(values.data(), values.size() * 4, 16);
  std::vector<std::uint32_t> back(values.size());
  buffer.download(back.data(), back.size() * 4, 16);
  EXPECT_EQ(back, values);
  EXPECT_TRUE(test_device().validation_messages().empty());
}

TEST(Buffer, AnEmptyOneHasAnAddress) {
  const gpu::Buffer buffer(test_device(), 0);
  EXPECT_NE(buffer.address(), 0u);
  EXPECT_EQ(buffer.bytes(), 0u);
}

TEST(Buffer, MovingLeavesOneOwner) {
  gpu::Buffer a(test_device(), 64, gpu::Memory::host);
  const std::uint64_t address = a.address();
  gpu::Buffer b = std::move(a);
  EXPECT_EQ(b.address(), address);
  b = gpu::Buffer(test_device(), 32);
  EXPECT_EQ(b.bytes(), 32u);
}

}  // namespace
}  // namespace nightcity::test
