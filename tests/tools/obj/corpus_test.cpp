// Every file kept by the fuzzers gives an Error or a city, never a crash.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/temp_folder.h"
#include "tests/tools/city/sound_picture.h"
#include "tests/tools/obj/bundle.h"
#include "tests/tools/obj/read_text.h"

namespace nightcity::obj {
namespace {

using namespace test;

const std::filesystem::path tests = NIGHTCITY_SOURCE_DIR "/tests/tools/obj";

TEST(ObjCorpus, EveryFileIsReadOrRefused) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tests / "corpus")) {
    ++files;
    EXPECT_FALSE(error_of_obj(test::read_text(entry.path())).empty()) << entry.path();
  }
  EXPECT_GE(files, 2u);
}

TEST(ObjCorpus, EveryPictureThatIsLaidHasItsPixelsAndAPlaceForEachVertex) {
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tests / "corpus_pictures")) {
    const TempFolder folder;
    city::ReadOptions options;
    options.textures = city::Textures::atlas;
    try {
      const City city = read_obj_file(write_bundle(folder, test::read_text(entry.path())), options);
      for (const city::CityObject& object : city.objects)
        for (const city::Polygon& polygon : object.polygons) {
          EXPECT_TRUE(has_sound_picture(polygon)) << entry.path();
          pictures += polygon.picture != nullptr;
        }
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "") << entry.path();
    }
  }
  EXPECT_GE(pictures, 10u);
}

}  // namespace
}  // namespace nightcity::obj
