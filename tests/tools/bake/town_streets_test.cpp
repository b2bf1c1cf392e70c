// The default town's streets are those of its map, with all that a mapped city gets.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/osm/read_osm.h"
#include "tools/town/roads.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

constexpr double slope = 0.3;  // to the east

// Tilts a model about its north: what is plane stays so, and walls stay upright.
void tilt(const fs::path& gml) {
  std::string text = bytes_of(gml), tilted;
  const std::string open = "<gml:posList", close = "</gml:posList>";
  std::size_t from = 0;
  for (std::size_t at; (at = text.find(open, from)) != std::string::npos;) {
    at = text.find('>', at) + 1;
    const std::size_t end = text.find(close, at);
    tilted.append(text, from, at - from);
    std::istringstream numbers(text.substr(at, end - at));
    char triple[100];
    for (double x, y, z; numbers >> x >> y >> z;) {
      std::snprintf(triple, sizeof triple, "%.4f %.4f %.4f ", x, y, z + slope * (x - 412000));
      tilted += triple;
    }
    from = end;
  }
  tilted.append(text, from);
  std::ofstream(gml, std::ios::binary) << tilted;
}

// Writes a town on a slope, with steps beside its map's first lamps, 8 m each to the east. Returns
// the recipe, which ends in `more`.
fs::path write_town_with_steps(const fs::path& folder, const std::string& more = {}) {
  town::TownOptions options;
  options.columns = options.rows = 3;
  options.hills_m = 0;
  town::write_town(options, folder);
  tilt(folder / "town.gml");
  const osm::OsmData town = osm::read_osm(folder / "town.osm");
  std::ofstream map(folder / "steps.osm");
  map << "<osm version='0.6'>\n";
  for (int n = 0; n < 40; ++n) {
    const glm::dvec2 p = town.lamps.at(static_cast<std::size_t>(n)).lon_lat + 3e-5;
    char text[400];
    std::snprintf(text, sizeof text,
                  "<node id='%d' lon='%.7f' lat='%.7f'/><node id='%d' lon='%.7f' lat='%.7f'/>"
                  "<way id='%d'><nd ref='%d'/><nd ref='%d'/><tag k='highway' v='steps'/></way>\n",
                  900'001 + 2 * n, p.x, p.y, 900'002 + 2 * n, p.x + 1.2e-4, p.y, 950'001 + n,
                  900'001 + 2 * n, 900'002 + 2 * n);
    map << text;
  }
  map << "</osm>\n";
  std::ofstream(folder / "steps.toml") << "[city]\nfiles = ['town.gml']\nroads = 'map'\n"
                                          "[osm]\nfiles = ['town.osm', 'steps.osm']\n"
                                       << more;
  return folder / "steps.toml";
}

double plan_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
                 const glm::dvec2& d) {
  const glm::dvec2 u = c - a, v = d - b;
  return std::abs(u.x * v.y - u.y * v.x) / 2;
}

// Returns the area of the carriageways of a plan: between their kerbs, junctions included.
double find_carriageways_m2(const town::StreetPlan& streets) {
  double sum_m2 = 0;
  town::for_each_stretch(streets, [&](const town::Stretch& s) {
    if (s.street != town::StreetClass::pedestrian && s.street != town::StreetClass::footway)
      sum_m2 += plan_area(s.kerb_right[0], s.kerb_right[1], s.kerb_left[1], s.kerb_left[0]);
  });
  for (int j = 0; j <= streets.rows(); ++j)
    for (int i = 0; i <= streets.columns(); ++i)
      sum_m2 += plan_area(streets.kerb(i - 1, j - 1)[2], streets.kerb(i, j - 1)[3],
                          streets.kerb(i, j)[0], streets.kerb(i - 1, j)[1]);
  return sum_m2;
}

TEST(TownStreets, HaveAllThatAMappedCityGets) {
  const TempFolder folder;
  town::write_town({}, folder.path());
  const BakeReport report = bake(read_recipe(folder / "town.toml"), folder / "out");
  EXPECT_FALSE(report.ground.has_roads);
  EXPECT_EQ(report.city.left_out.at("replaced by the map's ([city] roads)"),
            report.city.objects.at("road"));
  for (const char* marking :
       {"bar of a crossing", "dash between lanes", "stop line", "dash at which to give way",
        "line along a parking lane", "line between parking bays"})
    EXPECT_GT(report.cover.markings.at(marking), 0u) << marking;
  EXPECT_GT(report.cover.lowered_kerbs, 20u);
  EXPECT_GT(report.cover.rounded_corners, 100u);
  EXPECT_GT(report.cover.parking_m.at("lane, parallel"), 500);
  EXPECT_GT(report.cover.parking_m.at("half on kerb, parallel"), 500);
}

TEST(TownStreets, CarriagewaysAreAsLargeAsThePlans) {
  const TempFolder folder;
  // Streets end round at the town's edge, beyond the plan's, which weighs little in a large town.
  town::TownOptions options;
  options.columns = options.rows = 16;
  town::write_town(options, folder.path());
  std::ofstream(folder / "plain.toml") << "[city]\nfiles = ['town.gml']\nroads = 'map'\n"
                                          "[osm]\nfiles = ['town.osm']\n"
                                          "[ground]\nrounded_corners = false\nland = false\n"
                                          "[windows]\nlit = false\n";
  const BakeReport report = bake(read_recipe(folder / "plain.toml"), folder / "out");
  double drawn_m2 = 0;
  for (const char* name : {"asphalt", "sett", "road marking"})
    drawn_m2 += report.tiles.cover_m2.at(name);
  const double planned_m2 = find_carriageways_m2(town::StreetPlan(options));
  EXPECT_NEAR(drawn_m2, planned_m2, 0.01 * planned_m2);
}

TEST(TownStreets, StepsRiseAsTheGroundDoes) {
  const TempFolder folder;
  const BakeReport report = bake(read_recipe(write_town_with_steps(folder.path())), folder / "out");
  const steps::StepsReport& found = report.steps.found;
  EXPECT_EQ(found.ways, 40u);
  EXPECT_GT(found.flights, 5u);
  // Whole numbers of steps of 0.16 m.
  EXPECT_NEAR(static_cast<double>(found.treads), found.built_m * slope / steps::usual_riser_m,
              0.5 * static_cast<double>(found.flights));
  double left_out_m = 0;
  for (const auto& [reason, m] : found.left_out_m) left_out_m += m;
  EXPECT_NEAR(found.built_m + left_out_m, found.mapped_m, 1e-6 * found.mapped_m);
  // Each tread has a top, two sides and a riser, and each flight a wall at its upper end.
  EXPECT_LE(report.steps.triangles, 8 * found.treads + 2 * found.flights);
  EXPECT_GE(report.steps.triangles, 6 * found.treads);
}

TEST(TownStreets, OneWordTurnsStepsOff) {
  const TempFolder folder;
  const BakeReport report =
      bake(read_recipe(write_town_with_steps(folder.path(), "[ground]\nsteps = false\n")),
           folder / "out");
  EXPECT_EQ(report.steps.found.ways, 0u);
  EXPECT_EQ(report.steps.triangles, 0u);
}

TEST(TownStreets, PartsGiveTheBytesOfTheWholeBake) {
  const TempFolder folder;
  expect_parts_as_whole(write_town_with_steps(folder.path()), folder.path(), {3});
}

}  // namespace
}  // namespace nightcity::bake
