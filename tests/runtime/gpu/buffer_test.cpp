#include "runtime/gpu/buffer.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <string>
#include <thread>

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

// A city is uploaded in the background while pictures of another are rendered and read.
TEST(Buffer, TransfersOfSeveralThreadsDoNotMix) {
  std::vector<std::thread> threads;
  std::array<bool, 3> same{};
  for (std::uint32_t t = 0; t < same.size(); ++t)
    threads.emplace_back([&same, t] {
      const std::vector<std::uint32_t> values((std::size_t{20} << 20) / 4, t);
      gpu::Buffer buffer(test_device(), values.size() * 4);
      same[t] = true;
      for (int i = 0; i < 3; ++i) {
        buffer.upload(values.data(), values.size() * 4);
        same[t] = same[t] && buffer.read<std::uint32_t>(values.size()) == values;
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 0; t < same.size(); ++t) EXPECT_TRUE(same[t]) << t;
}

TEST(Buffer, BytesWrittenBeforeFirstUseAreThere) {
  const std::vector<std::uint32_t> values{1, 2, 3, 4, 5, 6, 7};
  gpu::Buffer buffer(test_device(), 64);
  buffer.upload_first(values.data(), values.size() * 4, 8);
  std::vector<std::uint32_t> back(values.size());
  buffer.download(back.data(), back.size() * 4, 8);
  EXPECT_EQ(back, values);
}

TEST(Buffer, BeyondTheDevicesMemoryTheErrorSaysHowMuchIsNeededAndFree) {
  gpu::Device::Options options;
  options.max_memory_bytes = 64 << 20;
  gpu::Device device(options);
  {
    const gpu::Buffer first(device, 40 << 20);
    const std::uint64_t free = device.free_memory();
    EXPECT_LE(free, 24u << 20);
    try {
      const gpu::Buffer second(device, 32 << 20);
      FAIL() << "allocated";
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_NE(
          text.find("33554432 bytes more are needed, and " + std::to_string(free) + " are free"),
          std::string::npos)
          << text;
    }
    EXPECT_LE(device.free_memory(), 24u << 20);
    EXPECT_NO_THROW(gpu::Buffer(device, 16 << 20));  // the failed one took nothing
  }
  const gpu::Buffer second(device, 60 << 20);  // the first was given back
}

// No machine has it, and a driver that promises it would have the system end the program.
TEST(Buffer, AnAbsurdSizeIsAnErrorNotACrash) {
  EXPECT_THROW(gpu::Buffer(test_device(), std::size_t{1} << 46), Error);
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
