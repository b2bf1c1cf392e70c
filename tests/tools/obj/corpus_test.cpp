// Every file kept by the fuzzers gives an Error or a city, never a crash.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/corpus.h"
#include "support/temp_folder.h"
#include "tests/tools/city/sound_picture.h"
#include "tests/tools/obj/bundle.h"
#include "tests/tools/obj/read_text.h"

namespace nightcity::obj {
namespace {

using namespace test;

const std::filesystem::path tests = NIGHTCITY_SOURCE_DIR "/tests/tools/obj";

TEST(ObjCorpus, EveryFileIsReadOrRefused) {
  expect_sound_files(tests / "corpus", 2, [](const std::filesystem::path& file) -> std::string {
    return error_of_obj(read_text(file)).empty() ? "is refused without a reason" : "";
  });
}

TEST(ObjCorpus, EveryPictureThatIsLaidHasItsPixelsAndAPlaceForEachVertex) {
  std::size_t pictures = 0;
  read_each_file(tests / "corpus_pictures", 1, [&](const std::filesystem::path& file) {
    const TempFolder folder;
    city::ReadOptions options;
    options.textures = city::Textures::atlas;
    const City city = read_obj_file(write_bundle(folder, read_text(file)), options);
    for (const city::CityObject& object : city.objects)
      for (const city::Polygon& polygon : object.polygons) {
        EXPECT_TRUE(has_sound_picture(polygon)) << file;
        pictures += polygon.picture != nullptr;
      }
  });
  EXPECT_GE(pictures, 10u);
}

}  // namespace
}  // namespace nightcity::obj
