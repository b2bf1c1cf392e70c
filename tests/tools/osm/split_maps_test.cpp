// One map in several files.
#include "tools/osm/split_maps.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "support/temp_folder.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

using test::TempFolder;
using test::write_text;

const std::string all_nodes =
    "<node id='1' version='1' lat='1' lon='1'/><node id='2' version='1' lat='1' lon='1.001'/>"
    "<node id='3' version='1' lat='1.001' lon='1.001'/>"
    "<node id='4' version='2' lat='1.001' lon='1'><tag k='highway' v='street_lamp'/></node>";
const std::string all_ways =
    "<way id='10' version='1'><nd ref='1'/><nd ref='2'/><nd ref='3'/></way>"
    "<way id='11' version='1'><nd ref='3'/><nd ref='4'/><nd ref='1'/></way>"
    "<way id='12' version='1'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='1'/>"
    "<tag k='building' v='house'/></way>"
    "<way id='13' version='1'><nd ref='1'/><nd ref='3'/><tag k='highway' v='service'/></way>";
const std::string all_relations =
    "<relation id='20' version='1'><member type='way' ref='10' role='outer'/>"
    "<member type='way' ref='11' role='outer'/><tag k='type' v='multipolygon'/>"
    "<tag k='building' v='school'/></relation>";
const std::string all_bounds = "<bounds minlon='0.5' minlat='0.5' maxlon='2' maxlat='2'/>";

struct Split {
  explicit Split(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      files.push_back(folder / (std::to_string(files.size()) + ".osm"));
      write_text(files.back(), "<osm version='0.6'>" + text + "</osm>");
    }
  }
  // "relation/20", ...; with what is broken as "broken".
  std::multiset<std::string> read_buildings() const {
    std::multiset<std::string> ids;
    for (const auto& file : files) {
      const MapAreas read = read_map_areas(file, {{"building"}}, 1000);
      for (const MapArea& area : read.areas) ids.insert(area.id);
      for (std::size_t i = 0; i < read.broken + read.open_ways; ++i) ids.insert("broken");
    }
    return ids;
  }
  TempFolder folder;
  std::vector<std::filesystem::path> files;
};

TEST(SplitMaps, NodesWaysAndRelationsInFilesOfTheirOwnAreOneMap) {
  const std::multiset<std::string> expected{"relation/20", "way/12"};
  for (const std::vector<std::string>& texts :
       {std::vector<std::string>{all_nodes, all_ways, all_relations},
        {all_relations, all_ways, all_nodes},
        {all_nodes, all_ways + all_relations},
        {all_relations + all_ways, all_nodes},
        {all_nodes + all_ways, all_relations}}) {
    const Split map(texts);
    const OsmData before = read_osm(map.files);
    const JoinedMaps joined = join_split_maps(map.files);
    ASSERT_EQ(joined.size(), texts.size());
    EXPECT_EQ(map.read_buildings(), expected);
    const OsmData after = read_osm(map.files);
    EXPECT_EQ(after.nodes, 4u);
    EXPECT_EQ(after.ways, 4u);
    EXPECT_EQ(after.relations, 1u);
    EXPECT_EQ(after.lamps.size(), 1u);
    ASSERT_EQ(after.highways.size(), 1u);
    EXPECT_EQ(after.highways[0].lon_lat, before.highways.at(0).lon_lat);
    EXPECT_EQ(after.missing_nodes, 0u);
  }
}

TEST(SplitMaps, TheFilesAreThemselvesAgainAfterwards) {
  const Split map({all_nodes, all_ways, all_relations});
  { const JoinedMaps joined = join_split_maps(map.files); }
  EXPECT_EQ(read_osm(map.files[1]).nodes, 0u);
  EXPECT_EQ(read_osm(map.files[1]).ways, 4u);
}

TEST(SplitMaps, MapsThatHoldTheirNodesStayAsTheyAre) {
  for (const std::vector<std::string>& texts :
       {std::vector<std::string>{all_nodes + all_ways + all_relations},
        {all_ways},
        {all_nodes + all_ways, all_nodes + all_relations},
        {all_ways + all_nodes, all_nodes},
        {all_nodes, all_nodes},
        {all_nodes, ""},
        {all_nodes,
         "<way id='9' version='1'><nd ref='7' lat='1' lon='1'/>"
         "<nd ref='8' lat='1' lon='2'/></way>"}}) {
    const Split map(texts);
    EXPECT_TRUE(join_split_maps(map.files).empty()) << texts.back();
  }
  Split missing({all_nodes, all_ways});
  missing.files.push_back(missing.folder / "none.osm");
  EXPECT_TRUE(join_split_maps(missing.files).empty());
  const Split editors({"<node id='-1' lat='1' lon='1'/>", "<way id='-1'><nd ref='-1'/></way>"});
  EXPECT_TRUE(join_split_maps(editors.files).empty()) << "ids of editors differ by file";
}

TEST(SplitMaps, TheNewestVersionsAndTheBoundsOfAllFilesCount) {
  const std::string older = "<node id='4' version='1' lat='7' lon='7'/>",
                    gone = "<way id='12' version='2' visible='false'/>";
  const Split map({all_bounds + older + all_nodes, all_bounds + all_ways, all_bounds + gone});
  const JoinedMaps joined = join_split_maps(map.files);
  ASSERT_EQ(joined.size(), 3u);
  EXPECT_EQ(map.read_buildings().count("way/12"), 0u);
  const OsmData read = read_osm(map.files);
  ASSERT_EQ(read.lamps.size(), 1u);
  EXPECT_EQ(read.lamps[0].lon_lat.y, 1.001);
  ASSERT_TRUE(read.bounds);
  EXPECT_EQ(read.bounds->low, glm::dvec2(0.5));
  EXPECT_EQ(read.bounds->high, glm::dvec2(2));
}

}  // namespace
}  // namespace nightcity::osm
