// Tests what a city passes on while it is read, and what it answers afterwards.
#include "tools/bake/city/city.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/error_message.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/two_files.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::bake {
namespace {

using test::message_of;
using test::TempFolder;
using test::write_text;

/// Writes down the objects whose turn has come.
class Listener final : public CityConsumer {
 public:
  Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override {
    return [this, prepared](bool continues) {
      ids.push_back(prepared->object.id);
      pieces += continues;
      closed += prepared->closed;
      triangles += prepared->mesh.triangles.size();
    };
  }

  std::vector<std::string> ids;
  std::size_t pieces = 0, closed = 0, triangles = 0;
};

TEST(City, EveryConsumerGetsEachObjectOnceInTheOrderOfTheFiles) {
  const TempFolder folder;
  City city(two_files(folder), folder / "scratch");
  Listener one, other;
  const CityReport report = city.read({&one, nullptr, &other}, {});
  EXPECT_EQ(one.ids, (std::vector<std::string>{"cube", "relief"}));
  EXPECT_EQ(other.ids, one.ids);
  EXPECT_EQ(one.pieces, 0u);
  EXPECT_EQ(one.closed, 1u) << "the cube";
  EXPECT_EQ(one.triangles, 14u);
  EXPECT_EQ(report.objects.at("building"), 2u);
  EXPECT_EQ(report.left_out.at("in two files"), 2u);
}

TEST(City, AnObjectThatStandsTwiceInOneFileIsTakenOnce) {
  const TempFolder folder;
  CityInputs inputs = two_files(folder);
  inputs.files.pop_back();
  std::string text = test::sample_gml();
  const std::size_t begin = text.find("<core:cityObjectMember>"),
                    end = text.find("<core:cityObjectMember>", begin + 1);
  write_text(inputs.files[0], text.insert(begin, text.substr(begin, end - begin)));
  const CityReport report = City(inputs, folder / "scratch").read({}, {});
  EXPECT_EQ(report.objects.at("building"), 2u);
  EXPECT_EQ(report.left_out.at("twice in one file"), 1u);
}

TEST(City, AnswersQueriesOfPlacesOnceItsGroundIsBuilt) {
  const TempFolder folder;
  City city(two_files(folder), folder / "scratch");
  city.read({}, {});
  std::size_t shown = 0;
  const GroundReport ground = city.build_ground(
      {}, [&](const mesh::TriangleMesh& mesh) { shown += mesh.triangles.size(); });
  EXPECT_EQ(ground.source, "given");
  EXPECT_EQ(shown, 0u) << "the model's own relief is an object of it";
  EXPECT_NEAR(city.height_at()({391030, 5819010}).value(), 35, 1e-6);
  EXPECT_FALSE(city.height_at()({391100, 5819010}));
  EXPECT_TRUE(city.inside_footprint()({391005, 5819005}));
  EXPECT_FALSE(city.inside_footprint()({391030, 5819010}));
  const glm::dvec2 place(391005, 5819005);
  const glm::dvec2 again = city.to_frame()(city.frame().to_lon_lat(place));
  EXPECT_NEAR(again.x, place.x, 1e-3);
  EXPECT_NEAR(again.y, place.y, 1e-3);
}

// Writes a map of square buildings, each from its low to its high corner, in metres from the
// cube's.
void write_buildings(const std::filesystem::path& path, const georeference::CityFrame& frame,
                     const std::vector<std::array<double, 4>>& squares,
                     const std::string& key = "building", const std::string& value = "yes") {
  std::string nodes, ways;
  int node = 0, way = 0;
  for (const auto& [x0, y0, x1, y1] : squares) {
    const int first = node + 1;
    ways += "<way id=\"" + std::to_string(++way) + "\" version=\"1\">";
    for (const glm::dvec2& corner :
         {glm::dvec2(x0, y0), glm::dvec2(x1, y0), glm::dvec2(x1, y1), glm::dvec2(x0, y1)}) {
      const glm::dvec2 p = frame.to_lon_lat(glm::dvec2(391000, 5819000) + corner);
      char text[128];
      std::snprintf(text, sizeof text, R"(<node id="%d" lon="%.9f" lat="%.9f" version="1"/>)",
                    ++node, p.x, p.y);
      nodes += text;
      ways += "<nd ref=\"" + std::to_string(node) + "\"/>";
    }
    ways += "<nd ref=\"" + std::to_string(first) + "\"/><tag k=\"" + key + "\" v=\"" + value +
            "\"/><tag k=\"height\" v=\"6\"/></way>";
  }
  write_text(path, "<osm version=\"0.6\">" + nodes + ways + "</osm>");
}

TEST(City, BuildingsOfTheMapStandWhereTheModelHasNone) {
  const TempFolder folder;
  CityInputs inputs = two_files(folder);
  {
    const City model(inputs, folder / "scratch");
    write_buildings(folder / "map.osm", model.frame(),
                    {{0.3, 0.2, 10.4, 10.1},  // the cube itself, a little displaced
                     {30, 20, 40, 30},        // free
                     {9.5, 0, 20, 10},        // a neighbour, over the cube by a twentieth
                     {8, -15, 14, 1.5},       // over it by its corner
                     {45, 30, 60, 38},        // partly beyond the ground
                     {100, 100, 110, 110}});  // beyond it
  }
  inputs.maps = {folder / "map.osm"};
  City city(inputs, folder / "scratch");
  city.read({}, {});
  Listener listener;
  city.build_ground({&listener, nullptr});
  EXPECT_EQ(listener.ids, (std::vector<std::string>{"way/2", "way/3", "way/4"}));
  EXPECT_EQ(listener.closed, 3u);
  EXPECT_EQ(city.gaps().buildings, 3u);
  EXPECT_EQ(city.gaps().left_out.at("building that the model has"), 1u);
  EXPECT_EQ(city.gaps().left_out.at("building beyond the ground"), 2u);
  // They are buildings of the city: nothing else stands in them, and their roofs are 6 m high.
  EXPECT_TRUE(city.inside_footprint()({391035, 5819025}));
  EXPECT_NEAR(city.terrain().height_of(terrain::SurfaceClass::roof, {391035, 5819025}).value(), 41,
              1e-6);

  inputs.cover.gaps = false;
  City bare(inputs, folder / "scratch");
  bare.read({}, {});
  bare.build_ground();
  EXPECT_EQ(bare.gaps().buildings, 0u);
  EXPECT_FALSE(bare.inside_footprint()({391035, 5819025}));
}

TEST(City, ChimneysAndTanksOfTheMapStandWhereTheModelHasNothing) {
  const TempFolder folder;
  CityInputs inputs = two_files(folder);
  {
    const City model(inputs, folder / "scratch");
    write_buildings(folder / "map.osm", model.frame(), {{2, 2, 6, 6}, {30, 20, 34, 24}}, "man_made",
                    "silo");
  }
  inputs.maps = {folder / "map.osm"};
  City city(inputs, folder / "scratch");
  city.read({}, {});
  Listener listener;
  city.build_ground({&listener, nullptr});
  EXPECT_EQ(listener.ids, (std::vector<std::string>{"way/2"}));
  EXPECT_EQ(city.gaps().left_out.at("building that the model has"), 1u);
  EXPECT_NEAR(city.terrain().height_of(terrain::SurfaceClass::roof, {391032, 5819022}).value(), 41,
              1e-6);
}

TEST(City, AMapAloneStandsOnAPlaneInItsUtmZone) {
  const TempFolder folder;
  write_text(folder / "map.osm", test::sample_osm());
  CityInputs inputs;
  inputs.maps = {folder / "map.osm"};
  City city(inputs, folder / "scratch");
  EXPECT_FALSE(city.has_model());
  EXPECT_TRUE(city.read({}, {}).objects.empty());
  EXPECT_EQ(city.build_ground().source, "");
  EXPECT_EQ(city.frame().crs(), "EPSG:32633");
  EXPECT_EQ(city.height_at()({0, 0}), 0.0);
  EXPECT_FALSE(city.inside_footprint());
  const Georeference georeference = city.georeference();
  EXPECT_EQ(georeference.crs, "EPSG:32633");
  EXPECT_EQ(georeference.sources, std::vector<std::string>{"map.osm"});
  EXPECT_EQ(georeference.licences, std::vector<std::string>{inputs.map_licence});
  EXPECT_EQ(georeference.origin.x, std::round(georeference.origin.x));
  EXPECT_THROW(city.frames(), UsageError);
}

TEST(City, TheOriginIsTheInputsThenTheCallersThenTheMiddle) {
  const TempFolder folder;
  CityInputs inputs = two_files(folder);
  inputs.origin_northing = 5819123.25;
  const City city(inputs, folder / "scratch");
  EXPECT_EQ(city.georeference(glm::dvec2(391777, 5)).origin.x, 391777);
  EXPECT_EQ(city.georeference(glm::dvec2(391777, 5)).origin.y, 5819123.25);
  EXPECT_NEAR(city.georeference().origin.x, 391005, 50);
}

TEST(City, ErrorsNameAFile) {
  const TempFolder folder;
  write_text(folder / "empty.osm", "<osm version=\"0.6\"></osm>");
  CityInputs inputs;
  inputs.maps = {folder / "empty.osm"};
  const City empty(inputs, folder / "scratch");
  EXPECT_NE(message_of([&] { empty.frame(); }).find("empty.osm"), std::string::npos);

  inputs = two_files(folder);
  inputs.frame.crs_override = "none";
  inputs.recipe = "town.toml";
  const City city(inputs, folder / "scratch");
  const std::string message = message_of([&] { city.require_lon_lat("lamps cannot be placed"); });
  EXPECT_NE(message.find("town.toml"), std::string::npos) << message;
  EXPECT_NE(message.find("[city] crs"), std::string::npos) << message;
  EXPECT_NE(message.find("lamps cannot be placed"), std::string::npos) << message;
}

TEST(City, WithoutGeometryNamesTheFilesThatItIsLinkedFrom) {
  const TempFolder folder;
  write_text(
      folder / "a.gml",
      "<CityModel xmlns:gml=\"http://www.opengis.net/gml\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\"><cityObjectMember><Building gml:id=\"b\">"
      "<lod1MultiSurface><gml:MultiSurface><gml:surfaceMember xlink:href=\"lib.gml#p\"/>"
      "<gml:surfaceMember xlink:href=\"far.gml#p\"/></gml:MultiSurface></lod1MultiSurface>"
      "</Building></cityObjectMember></CityModel>");
  write_text(folder / "lib.gml", test::sample_gml());
  CityInputs inputs;
  inputs.files = {folder / "a.gml"};
  const std::string message = message_of([&] { City city(inputs, folder / "scratch"); });
  EXPECT_NE(message.find((folder / "lib.gml").string() + ", which is not listed"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find((folder / "far.gml").string() + ", which is not there"), std::string::npos)
      << message;
}

TEST(City, AMapAmongModelsIsRefusedByName) {
  const TempFolder folder;
  CityInputs inputs = two_files_and_map(folder);
  inputs.files.push_back(folder / "map.osm");
  const std::string message = message_of([&] { City city(inputs, folder / "scratch"); });
  EXPECT_NE(message.find("map.osm: is a map (OSM) and no city model"), std::string::npos)
      << message;
}

TEST(City, MapsGoWithTheirCity) {
  const TempFolder folder;
  const CityInputs inputs = two_files_and_map(folder);
  std::weak_ptr<map_buildings::CityMaps> kept;
  {
    const City one(inputs, folder / "one"), other(inputs, folder / "other");
    kept = one.inputs().read.maps;
    EXPECT_NE(one.inputs().read.maps, other.inputs().read.maps);
    EXPECT_FALSE(kept.expired());
  }
  EXPECT_TRUE(kept.expired());
}

}  // namespace
}  // namespace nightcity::bake
