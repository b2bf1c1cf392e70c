// Every raster that the fuzzer starts from or has found, read in each test run.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/corpus.h"
#include "support/temp_folder.h"
#include "tests/tools/terrain/sound_raster.h"

namespace nightcity::terrain {
namespace {

const auto raster_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/terrain/corpus";

TEST(RasterCorpus, EveryRasterIsReadOrRefused) {
  test::expect_sound_files(raster_corpus, 5, [](const std::filesystem::path& file) {
    const std::string bytes = test::read_text(file);
    const test::TempFolder folder;
    test::write_text(folder / test::name_raster(bytes), bytes);
    return test::find_fault_of_raster(folder / test::name_raster(bytes));
  });
}

TEST(RasterCorpus, HoldsWholeRastersOfSeveralFormats) {
  for (const char* name : {"degrees.tif", "tiled.tif", "plane.asc", "plane.nc", "plane.hf2"}) {
    const std::string bytes = test::read_text(raster_corpus / name);
    const test::TempFolder folder;
    test::write_text(folder / test::name_raster(bytes), bytes);
    const ElevationModel model(folder / test::name_raster(bytes));
    std::size_t known = 0;
    for (const auto& places : test::list_places()) {
      std::vector<double> heights(places.size());
      model.sample(places, heights);
      for (const double height : heights) known += !std::isnan(height);
    }
    EXPECT_GT(known, 20u) << name;
  }
}

}  // namespace
}  // namespace nightcity::terrain
