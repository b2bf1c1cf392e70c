// Tests what stages make of a city: of its lamps, windows and tiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "support/temp_folder.h"
#include "tests/tools/bake/two_files.h"
#include "tools/bake/city/building_uses.h"
#include "tools/bake/city/tile_grid.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/bake/stages/window_stage.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;
using test::write_text;

TEST(LampStage, NotesOfLuminaireFilesReachTheReport) {
  const TempFolder folder;
  City city(two_files_and_map(folder), folder / "scratch");
  write_text(folder / "probe.ies",
             "IESNA:LM-63-2002\n[TEST] Probe\nTILT=lamp.tlt\n1 1000 1 3 1 1 2 0 0 0\n1 1 50\n"
             "0 45 90\n0\n100 100 100\n");
  LampStageOptions options;
  options.luminaires.push_back({folder / "probe.ies", {}, {}});
  const CityLamps lamps = place_city_lamps(city, options);
  const auto is_note = [](const auto& note) { return note.first.starts_with("probe.ies: TILT="); };
  EXPECT_EQ(std::count_if(lamps.set.notes.begin(), lamps.set.notes.end(), is_note), 1);
}

TEST(WindowConsumer, SingleWindowsHavePanesUnlessTheyAreToBeEven) {
  const auto name_of = [](bool panes, lights::WindowGrouping group) {
    WindowStageOptions options;
    options.panes = panes;
    options.group = group;
    const std::filesystem::path scratch = std::filesystem::temp_directory_path() / "window_names";
    return std::string(WindowConsumer({}, options, scratch).material_name());
  };
  EXPECT_EQ(name_of(true, lights::WindowGrouping::none), window_pane_material);
  EXPECT_EQ(name_of(false, lights::WindowGrouping::none), even_window_material);
  EXPECT_EQ(name_of(true, lights::WindowGrouping::storey), even_window_material);
  EXPECT_EQ(name_of(true, lights::WindowGrouping::facade), even_window_material);
}

TEST(WindowConsumer, EveryPieceOfALargeBuildingGetsWindows) {
  const TempFolder folder;
  City city(two_files(folder), folder / "scratch");
  Collector collector;
  city.read({&collector}, {});
  city.build_ground();
  const auto& cube = collector.objects.at(0);
  const auto piece = std::make_shared<PreparedObject>(*cube);
  for (city::Polygon& polygon : piece->object.polygons)
    for (glm::dvec3& p : polygon.exterior) p.x += 25;
  WindowConsumer windows(make_use_finder(city), {}, folder / "windows");
  windows.prepare(cube)(false);
  windows.prepare(piece)(true);
  std::size_t first = 0, second = 0;
  windows.finish(city, [&](const lights::LitRectangle& window) {
    ++(window.centre.x < 391015 ? first : second);
  });
  EXPECT_GT(first, 0u);
  EXPECT_GT(second, 0u);
}

TEST(ObjectTiles, AnObjectSmallerThanATileStaysWholeALargerOneIsDivided) {
  const glm::dvec3 west[3] = {{95, 5, 0}, {99, 5, 0}, {99, 9, 0}},
                   east[3] = {{102, 5, 0}, {104, 5, 0}, {104, 9, 0}},
                   far[3] = {{-250, 5, 0}, {-240, 5, 0}, {-245, 9, 0}};
  ObjectTiles house(100);
  house.add(west);
  house.add(east);
  EXPECT_EQ(house.find_tile(west), (Tile{0, 0}));
  EXPECT_EQ(house.find_tile(east), (Tile{0, 0}));
  ObjectTiles street = house;
  street.add(far);
  EXPECT_EQ(street.find_tile(west), (Tile{0, 0}));
  EXPECT_EQ(street.find_tile(east), (Tile{1, 0}));
  EXPECT_EQ(street.find_tile(far), (Tile{-3, 0}));
}

}  // namespace
}  // namespace nightcity::bake
