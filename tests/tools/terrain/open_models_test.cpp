// Elevation models come in classes of resolution, the finest first.
#include "tools/terrain/open_models.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/temp_folder.h"

namespace nightcity::terrain {
namespace {

using test::TempFolder;

// A grid of 3 x 3 heights in metres.
std::filesystem::path write_grid(const TempFolder& folder, const std::string& step_m) {
  const std::filesystem::path path = folder / ("every_" + step_m + ".asc");
  test::write_text(path, "ncols 3\nnrows 3\nxllcorner 390995\nyllcorner 5818995\ncellsize " +
                             step_m + "\n7 7 7\n7 7 7\n7 7 7\n");
  return path;
}

TEST(ResolutionClasses, AClassReachesToOneAndAHalfTimesItsFinest) {
  const TempFolder folder;
  std::vector<std::filesystem::path> files;
  for (const char* step_m : {"5", "1.6", "1.4", "1", "1.2", "1.5"})
    files.push_back(write_grid(folder, step_m));
  const auto models = open_elevation_models(files, {});
  std::vector<double> steps_m;
  for (const ElevationModel& model : models) steps_m.push_back(model.resolution_m());
  EXPECT_EQ(steps_m, (std::vector{1.4, 1.0, 1.2, 1.5, 1.6, 5.0})) << "files of a class in order";
  const auto classes = find_resolution_classes(models);
  ASSERT_EQ(classes.size(), 3u);
  EXPECT_EQ(classes[0].begin, 0u);
  EXPECT_EQ(classes[0].step_m, 1);
  EXPECT_EQ(classes[1].begin, 4u);
  EXPECT_EQ(classes[1].step_m, 1.6);
  EXPECT_EQ(classes[2].begin, 5u);
  EXPECT_EQ(classes[2].step_m, 5);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(classes[i].end, i < 2 ? classes[i + 1].begin : models.size());
}

TEST(ResolutionClasses, NoModelHasNone) {
  EXPECT_TRUE(find_resolution_classes({}).empty());
}

}  // namespace
}  // namespace nightcity::terrain
