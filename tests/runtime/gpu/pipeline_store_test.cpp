#include "runtime/gpu/pipeline_store.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "formats/checksum.h"
#include "support/gpu.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::test {
namespace {

// Starts a device that keeps its pipelines in `folder`, renders a frame, and ends it. Returns the
// file, and how many of its bytes the driver was given.
struct Start {
  std::filesystem::path file;
  std::size_t read_bytes;
};
Start start(const std::filesystem::path& folder) {
  gpu::Device::Options options;
  options.pipeline_folder = folder;
  gpu::Device device(options);
  const scene::RenderScene scene = SceneBuilder().ground(30).with({lamp({0, 6, 0}, 3000)});
  render::DeviceScene device_scene(device, scene);
  render::PassLibrary passes(device);
  render::Renderer renderer(device, passes, device_scene, 8, 8);
  renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, {});
  return {device.pipeline_store()->file(), device.pipeline_store()->read_bytes()};
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(PipelineStore, TheSecondStartReadsWhatTheFirstWrote) {
  const TempFolder folder;
  const Start first = start(folder / "cache/nightcity");
  EXPECT_EQ(first.read_bytes, 0u);
  ASSERT_TRUE(std::filesystem::exists(first.file));
  const Start second = start(folder / "cache/nightcity");
  EXPECT_EQ(second.file, first.file);
  EXPECT_GT(second.read_bytes, 0u);
}

TEST(PipelineStore, ADamagedOrForeignFileIsIgnoredAndReplaced) {
  const TempFolder folder;
  const std::filesystem::path file = start(folder.path()).file;
  const std::string good = read_bytes(file);
  ASSERT_GT(good.size(), 40u);
  std::string flipped = good, foreign = good, empty;
  flipped[good.size() - 1] ^= 1;
  // Another driver's file under this name, whole in itself.
  foreign[16] ^= 1;
  const std::uint64_t sum = checksum(foreign.data() + 16, foreign.size() - 16);
  std::memcpy(foreign.data() + 8, &sum, sizeof sum);
  for (const std::string& bad :
       {flipped, foreign, empty, good.substr(0, 20), std::string(1000, 'x')}) {
    write_bytes(file, bad);
    EXPECT_EQ(start(folder.path()).read_bytes, 0u);
    EXPECT_GT(start(folder.path()).read_bytes, 0u);  // it was replaced by one that fits
  }
}

TEST(PipelineStore, WithoutAFolderOrWithOneThatCannotBeNothingIsKeptAndNothingFails) {
  EXPECT_EQ(start("").read_bytes, 0u);
  const TempFolder folder;
  write_bytes(folder / "file", "no folder");
  EXPECT_EQ(start(folder / "file/cache").read_bytes, 0u);
  EXPECT_EQ(read_bytes(folder / "file"), "no folder");
}

class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value ? ::setenv(name, value, 1) : ::unsetenv(name);
  }
  ~Variable() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(PipelineStore, LiesInTheCacheFolderOfTheUser) {
  const Variable home("HOME", "/home/me");
  {
    const Variable cache("XDG_CACHE_HOME", "/var/my-cache");
    EXPECT_EQ(gpu::find_cache_folder(), "/var/my-cache/nightcity");
  }
  for (const char* unfit : {static_cast<const char*>(nullptr), "", "relative/folder"}) {
    const Variable cache("XDG_CACHE_HOME", unfit);
    EXPECT_EQ(gpu::find_cache_folder(), "/home/me/.cache/nightcity");
  }
  const Variable cache("XDG_CACHE_HOME", nullptr), none("HOME", nullptr);
  EXPECT_EQ(gpu::find_cache_folder(), "");
}

}  // namespace
}  // namespace nightcity::test
