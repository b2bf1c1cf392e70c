// OSM data in JSON is read as the same data in XML.
#include "tools/osm/osm_json.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <string>
#include <string_view>

#include "support/error_message.h"
#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

using test::message_of;
using test::TempFolder;
using test::write_text;

const std::string nodes =
    R"({"version":0.6,"generator":"Overpass API","osm3s":{"copyright":"ODbL"},"elements":[
{"type":"node","id":1,"lat":1,"lon":2,"tags":{"highway":"street_lamp","name":"A & \"B\" <ß>"}},
{"type":"node","id":2,"lat":1,"lon":2.001},{"type":"node","id":3,"lat":1.001,"lon":2},
{"type":"way","id":7,"nodes":[1,2,3,1],"tags":{"building":"yes"}}]})";

// As `out geom` answers: places at the ways and members themselves.
const std::string places =
    R"({"version":0.6,"generator":"Overpass API","elements":[
{"type":"way","id":7,"nodes":[1,2,3,1],"geometry":[{"lat":1,"lon":2},{"lat":1,"lon":2.001},
{"lat":1.001,"lon":2},{"lat":1,"lon":2}],"tags":{"building":"yes"}},
{"type":"relation","id":9,"tags":{"type":"multipolygon","landuse":"grass"},"members":[
{"type":"way","ref":8,"role":"outer","geometry":[{"lat":5,"lon":2},{"lat":5,"lon":2.001},
{"lat":5.001,"lon":2},{"lat":5,"lon":2}]}]}]})";

TEST(OsmJson, NodesWaysAndTagsAreRead) {
  const TempFolder folder;
  write_text(folder / "map.json", nodes);
  const OsmData data = read_osm(folder / "map.json");
  ASSERT_EQ(data.lamps.size(), 1u);
  EXPECT_EQ(data.lamps[0].lon_lat, glm::dvec2(2, 1));
  EXPECT_EQ(data.lamps[0].tags.at("name"), "A & \"B\" <\xC3\x9F>");
  ASSERT_EQ(data.buildings.size(), 1u);
  EXPECT_EQ(data.buildings[0].lon_lat.size(), 4u);
}

TEST(OsmJson, PlacesAtWaysAndMembersAreRead) {
  const TempFolder folder;
  write_text(folder / "map.json", "\xEF\xBB\xBF" + places);
  const OsmData data = read_osm(folder / "map.json");
  ASSERT_EQ(data.buildings.size(), 1u);
  EXPECT_EQ(data.buildings[0].lon_lat.at(1), glm::dvec2(2.001, 1));
  const auto found = read_map_areas(folder / "map.json", {{"landuse"}}, 100);
  EXPECT_EQ(found.areas.size(), 1u);
}

// As `jq -S` and others write it: by name, so that the elements come before what says whose they
// are.
TEST(OsmJson, MembersMayStandInAnyOrder) {
  const TempFolder folder;
  const auto lamps = [&](std::string_view elements, std::string_view rest) {
    write_text(folder / "map.json",
               "{\"elements\": [\n" + std::string(elements) + "]" + std::string(rest) + "}");
    return read_osm(folder / "map.json").lamps.size();
  };
  const std::string lamp =
      R"({"id": 1, "lat": 1, "lon": 2, "tags": {"highway": "street_lamp"}, "type": "node"})";
  const std::string way =
      R"({"bounds": {"maxlat": 2, "maxlon": 2, "minlat": 1, "minlon": 1}, "geometry": [)" +
      std::string(2000, ' ') + R"(], "id": 7, "nodes": [], "type": "way"})";
  EXPECT_EQ(lamps(lamp, ", \"generator\": \"Overpass API\", \"version\": 0.6"), 1u);
  EXPECT_EQ(lamps(lamp, ""), 1u);
  EXPECT_EQ(lamps(way + "," + lamp, ""), 1u);
  EXPECT_FALSE(begins_as_osm_json(R"({"elements":[{"symbol":"H","number":1}]})"));
  EXPECT_FALSE(begins_as_osm_json(R"({"lamps":[{"type":"node","lat":1}]})"));
}

TEST(OsmJson, MayBePacked) {
  const TempFolder folder;
  test::pack_zip(folder / "map.zip", {{"export.json", nodes}, {"meta.json", "{\"a\":1}"}});
  EXPECT_EQ(read_osm(folder / "map.zip").lamps.size(), 1u);
  gzFile file = gzopen((folder / "map.json.gz").c_str(), "wb");
  gzwrite(file, nodes.data(), static_cast<unsigned>(nodes.size()));
  gzclose(file);
  EXPECT_EQ(read_osm(folder / "map.json.gz").lamps.size(), 1u);
}

TEST(OsmJson, FaultsAreNamed) {
  const TempFolder folder;
  const auto why = [&](const std::string& text) {
    write_text(folder / "map.json", text);
    return message_of([&] { read_osm(folder / "map.json"); });
  };
  EXPECT_NE(why(nodes.substr(0, nodes.size() - 20)).find("map.json: is no whole JSON"),
            std::string::npos);
  const std::string late = nodes.substr(0, nodes.size() - 1) + ",\"remark\":\"runtime error\"}";
  EXPECT_NE(why(late).find("incomplete"), std::string::npos) << why(late);
  std::string deep = nodes.substr(0, nodes.size() - 2) + ",{\"type\":\"way\",\"tags\":";
  for (int i = 0; i < 100'000; ++i) deep += '[';
  EXPECT_NE(why(deep).find("in each other"), std::string::npos);
  // An element's values of other kinds are passed over.
  write_text(folder / "map.json",
             R"({"generator":"x","elements":[7,{"type":3},{"type":"node","id":{},"tags":[]},
{"type":"way","id":1,"nodes":7,"geometry":[null,3]},{"type":"relation","id":1,"members":[1,{}]}]})");
  EXPECT_NO_THROW(read_osm(folder / "map.json"));
}

TEST(OsmJson, MoreThanFitsIntoMemoryIsRefused) {
  const TempFolder folder;
  write_text(folder / "map.json", nodes);
  constexpr std::array<std::string_view, 1> endings{".json"};
  const city::Document document = city::list_documents(folder / "map.json", endings).front();
  ScratchFile xml(folder / "xml");
  EXPECT_NO_THROW(write_as_xml(document, xml, nodes.size()));
  EXPECT_NE(message_of([&] { write_as_xml(document, xml, nodes.size() - 1); }).find("PBF"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity::osm
