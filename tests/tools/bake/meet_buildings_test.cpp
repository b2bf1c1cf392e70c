// Elevation models are moved to where buildings stand, and doubted where that does not suffice.
#include "tools/bake/city/meet_buildings.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "support/temp_folder.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

using Height = std::function<double(double east, double north)>;

// Writes heights every `step_m` from (0, 0) to (`east_m`, 100).
void write_grid(const std::filesystem::path& path, int step_m, int east_m, const Height& height) {
  const int columns = east_m / step_m, rows = 100 / step_m;
  std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
                     "\nxllcorner 0\nyllcorner 0\ncellsize " + std::to_string(step_m) + "\n";
  for (int row = rows - 1; row >= 0; --row)
    for (int column = 0; column < columns; ++column)
      text += std::to_string(height((column + 0.5) * step_m, (row + 0.5) * step_m)) +
              (column + 1 < columns ? " " : "\n");
  test::write_text(path, text);
}

// The corners of buildings of 10 m, one every 20 m, on ground that rises by 1 in 100.
std::vector<glm::dvec3> make_feet() {
  std::vector<glm::dvec3> feet;
  for (int east = 10; east <= 90; east += 10)
    for (int north = 10; north <= 90; north += 10)
      feet.emplace_back(east, north, 30 + east / 100.0);
  return feet;
}

struct Met {
  std::vector<double> heights;  // at 15 and 85 m east
  std::string text;
};

Met meet(const std::vector<std::filesystem::path>& models) {
  const auto frame = georeference::CityFrame::from_srs_name("", {}, {});
  GroundOptions options;
  options.elevation_models = models;
  GroundHeights heights(options, frame);
  Met met;
  met.text = meet_buildings(heights, make_feet());
  met.heights = heights.at(std::vector<glm::dvec2>{{15, 50}, {85, 50}});
  return met;
}

TEST(MeetBuildings, EachKindOfModelsIsMovedByItself) {
  const TempFolder folder;
  const auto slope = [](double moved_by) {
    return [=](double east, double) { return 30 + moved_by + east / 100; };
  };
  write_grid(folder / "fine.asc", 2, 50, slope(0.25));
  write_grid(folder / "coarse.asc", 5, 100, slope(38));
  for (const auto& models : {std::vector{folder / "fine.asc", folder / "coarse.asc"},
                             std::vector{folder / "coarse.asc", folder / "fine.asc"}}) {
    const Met met = meet(models);
    EXPECT_NEAR(met.heights.at(0), 30.15, 0.02);
    EXPECT_NEAR(met.heights.at(1), 30.85, 0.02);
    EXPECT_EQ(met.text, "moved by -0.25 m (those every 5 m by -38.00 m) to meet the buildings");
  }
}

TEST(MeetBuildings, AModelThatShowsRoofsIsDoubted) {
  const TempFolder folder;
  write_grid(folder / "dom.asc", 1, 100, [](double east, double north) {
    const bool on_roof = static_cast<int>(north) / 20 % 2 == 0;
    return 30 + east / 100 + (on_roof ? 8 + east / 10 : 0);
  });
  EXPECT_NE(meet({folder / "dom.asc"}).text.find("a surface model (with roofs)"),
            std::string::npos);
}

TEST(MeetBuildings, HeightsThatNoDatumExplainsAreDoubted) {
  const TempFolder folder;
  const auto shifted = [&](double moved_by) {
    write_grid(folder / "dgm.asc", 5, 100,
               [=](double east, double) { return 30 + moved_by + east / 100; });
    return meet({folder / "dgm.asc"}).text;
  };
  EXPECT_EQ(shifted(-47), "moved by +47.00 m to meet the buildings");  // the geoid, in Europe
  EXPECT_NE(shifted(270).find("another unit"), std::string::npos);     // decimetres
}

}  // namespace
}  // namespace nightcity::bake
