// Reads each file that the fuzzers have kept: it must be read or refused with an Error.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/light_file.h"
#include "formats/mapped_file.h"
#include "formats/picture_mean.h"
#include "formats/scene_reader.h"
#include "support/corpus.h"
#include "support/fuzz_file.h"
#include "support/temp_folder.h"
#include "tests/formats/light_file_checksums.h"

namespace nightcity {
namespace {

template <class Reader>
void read_all(const char* folder, const Reader& reader) {
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/formats/corpus" / folder;
  EXPECT_GE(test::read_each_file(corpus, 3, reader).sound, 1u)
      << "a corpus of refused files alone teaches a fuzzer nothing";
}

TEST(Corpus, EveryPictureIsReadOrRefused) {
  read_all("picture", [](const std::filesystem::path& file) {
    const MappedFile bytes(file);
    if (!find_picture_mean(bytes.bytes(), true)) throw Error("", "is not read");
  });
}

TEST(Corpus, EveryGlbIsReadOrRefused) {
  read_all("glb", [](const std::filesystem::path& file) {
    const Scene scene = read_scene(file);
    for (const SceneMesh& mesh : scene.meshes)
      for (const ScenePrimitive& primitive : mesh.primitives)
        for (const glm::vec3& p : primitive.positions) EXPECT_TRUE(finite(p)) << file;
  });
}

TEST(Corpus, EveryLightFileIsReadOrRefused) {
  read_all("lights", [](const std::filesystem::path& file) {
    const std::string text = test::read_text(file);
    std::vector<std::uint8_t> bytes(text.begin(), text.end());
    test::fix_checksums(bytes);  // as the fuzzer does
    LightFile::open(test::FuzzFile(bytes.data(), bytes.size()).path()).verify();
  });
}

TEST(Corpus, HoldsWholeFilesWithEverythingInThem) {
  const auto corpus = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/formats/corpus";
  const Scene scene = read_scene(corpus / "glb/everything.glb");
  EXPECT_EQ(scene.features.size(), 2u);
  EXPECT_EQ(scene.nodes.at(1).instances.size(), 3u);
  EXPECT_NE(scene.nodes.at(1).vehicle, no_id);
  for (const char* name : {"glb/house.glb", "glb/house_draco.glb"})
    EXPECT_GE(read_scene(corpus / name).meshes.size(), 2u) << name;
  const LightFile lights = LightFile::open(corpus / "lights/traffic.lights");
  lights.verify();
  EXPECT_EQ(lights.lights().size(), 3u);
  EXPECT_EQ(lights.profiles().size(), 2u);
  EXPECT_EQ(lights.schedules().size(), 3u);
  EXPECT_EQ(lights.traffic().trips.size(), 2u);
  LightFile::open(corpus / "lights/windows.lights").verify();
}

}  // namespace
}  // namespace nightcity
