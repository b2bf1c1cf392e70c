// The files as a whole are repeatable, well-formed, of the size asked for, and consistent.
#include "tools/town/town.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "formats/error.h"
#include "tools/town/street_plan.h"

namespace nightcity::town {
namespace {

class Folder {
 public:
  explicit Folder(const char* name)
      : path_(std::filesystem::temp_directory_path() /
              (std::string("nightcity_town_") + name + "_" + std::to_string(::getpid()))) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const char* file) const { return path_ / file; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TownOptions small(std::uint64_t seed = 1) {
  TownOptions options;
  options.seed = seed;
  options.columns = 3;
  options.rows = 3;
  return options;
}

TEST(Town, SameSeedGivesTheSameBytesAndAnotherSeedDoesNot) {
  const Folder a("a"), b("b"), c("c");
  write_town(small(7), a.path());
  write_town(small(7), b.path());
  write_town(small(8), c.path());
  for (const char* file : {"town.gml", "town.osm", "town.toml"})
    EXPECT_EQ(content(a / file), content(b / file)) << file;
  EXPECT_NE(content(a / "town.gml"), content(c / "town.gml"));
  EXPECT_NE(content(a / "town.osm"), content(c / "town.osm"));
}

TEST(Town, GmlIsWellFormedWithUniqueIdsClosedRingsAndCountsAsReported) {
  const Folder folder("gml");
  const TownCounts counts = write_town(TownOptions{}, folder.path());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((folder / "town.gml").c_str()));

  double low[3], high[3];
  const pugi::xml_node envelope = document.select_node("//gml:Envelope").node();
  std::istringstream(envelope.child_value("gml:lowerCorner")) >> low[0] >> low[1] >> low[2];
  std::istringstream(envelope.child_value("gml:upperCorner")) >> high[0] >> high[1] >> high[2];

  std::size_t rings = 0, interiors = 0;
  for (const pugi::xpath_node& found : document.select_nodes("//gml:posList")) {
    std::istringstream text(found.node().child_value());
    std::vector<double> numbers;
    for (double number; text >> number;) numbers.push_back(number);
    ASSERT_TRUE(text.eof());
    ASSERT_EQ(numbers.size() % 3, 0u);
    ASSERT_GE(numbers.size(), 12u);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(numbers[axis], numbers[numbers.size() - 3 + axis]);
      for (std::size_t n = axis; n < numbers.size(); n += 3) {
        ASSERT_GE(numbers[n], low[axis]);
        ASSERT_LE(numbers[n], high[axis]);
      }
    }
    ++rings;
    interiors += std::string_view(found.node().parent().parent().name()) == "gml:interior";
  }
  EXPECT_EQ(rings - interiors, counts.polygons);
  EXPECT_GT(interiors, 0u);  // courtyards
  EXPECT_EQ(document.select_nodes("//bldg:Building").size(), counts.buildings);
  EXPECT_GT(document.select_nodes("//bldg:BuildingPart").size(), 0u);
  EXPECT_GT(document.select_nodes("//dem:TINRelief").size(), 0u);
  EXPECT_GT(document.select_nodes("//bldg:BuildingInstallation").size(), 0u);
  EXPECT_EQ(document.select_nodes("//veg:SolitaryVegetationObject").size(), counts.trees);
  EXPECT_GT(counts.trees, 100u);
  EXPECT_GT(document.select_nodes("//bldg:storeysAboveGround[text()='9999']").size(), 0u);

  std::set<std::string> ids, roofs;
  for (const pugi::xpath_node& found : document.select_nodes("//*[@gml:id]"))
    EXPECT_TRUE(ids.insert(found.node().attribute("gml:id").value()).second)
        << found.node().attribute("gml:id").value();
  for (const pugi::xpath_node& found : document.select_nodes("//bldg:roofType"))
    roofs.insert(found.node().child_value());
  EXPECT_GE(roofs.size(), 6u);
}

TEST(Town, DefaultIsATownAndNotAVillage) {
  const Folder folder("default");
  const TownCounts counts = write_town(TownOptions{}, folder.path());
  EXPECT_EQ(counts.blocks, 56u);
  EXPECT_GE(counts.buildings, 600u);
  EXPECT_LE(counts.buildings, 1500u);
  EXPECT_GE(counts.lamps, 300u);
  EXPECT_LE(counts.lamps, 400u);
  EXPECT_GE(counts.triangles, 50000u);
  EXPECT_LE(counts.triangles, 100000u);
}

TEST(Town, LampsAreExactlyAsManyLuminairesAsAskedFor) {
  for (const std::size_t lamps : {1u, 337u, 913u}) {
    const Folder folder("lamps");
    TownOptions options = small();
    options.lamps = lamps;
    EXPECT_EQ(write_town(options, folder.path()).lamps, lamps);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder / "town.osm").c_str()));
    std::size_t luminaires = 0;
    for (const pugi::xpath_node& found : document.select_nodes("//node[tag/@v='street_lamp']")) {
      const pugi::xml_node count = found.node().find_child_by_attribute("tag", "k", "light:count");
      luminaires += count ? count.attribute("v").as_uint() : 1;
    }
    EXPECT_EQ(luminaires, lamps);
  }
}

TEST(Town, OsmWaysReferToNodesOfTheFileAndMostLampsAreBare) {
  const Folder folder("osm");
  write_town(TownOptions{}, folder.path());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((folder / "town.osm").c_str()));
  std::set<std::string> nodes;
  std::size_t lamps = 0, bare = 0;
  for (const pugi::xml_node& node : document.child("osm").children("node")) {
    EXPECT_TRUE(nodes.insert(node.attribute("id").value()).second);
    if (!node.find_child_by_attribute("tag", "v", "street_lamp")) continue;
    ++lamps;
    bare += std::distance(node.children("tag").begin(), node.children("tag").end()) == 1;
  }
  EXPECT_GT(bare, lamps / 2);
  EXPECT_LT(bare, lamps);
  std::set<std::string> keys;
  for (const pugi::xml_node& way : document.child("osm").children("way")) {
    for (const pugi::xml_node& reference : way.children("nd"))
      EXPECT_TRUE(nodes.contains(reference.attribute("ref").value()));
    for (const pugi::xml_node& tag : way.children("tag")) keys.insert(tag.attribute("k").value());
  }
  for (const char* key : {"highway", "lit", "width", "lanes", "maxspeed", "oneway", "name"})
    EXPECT_TRUE(keys.contains(key)) << key;
}

TEST(Town, StreetsOfTheMapAreAsWideAsThePlans) {
  const Folder folder("widths");
  write_town(TownOptions{}, folder.path());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((folder / "town.osm").c_str()));
  std::set<std::string> seen;
  for (const pugi::xml_node& way : document.child("osm").children("way")) {
    const auto value = [&](const char* key) {
      return way.find_child_by_attribute("tag", "k", key).attribute("v");
    };
    if (!value("name") || value("area")) continue;
    const std::string highway = value("highway").value();
    for (const StreetClass street :
         {StreetClass::primary, StreetClass::secondary, StreetClass::tertiary,
          StreetClass::residential, StreetClass::living_street, StreetClass::pedestrian}) {
      if (highway != osm_name(street)) continue;
      seen.insert(highway);
      const StreetSize size = size_of(street);
      const double walls_m = size.carriageway_m + 2 * size.pavement_m;
      const double pavement_m = value("sidewalk:both:width").as_double();
      EXPECT_NEAR(value("width").as_double() + 2 * pavement_m, walls_m, 1e-6) << highway;
      EXPECT_EQ(pavement_m == 0, street == StreetClass::pedestrian);
    }
  }
  EXPECT_GE(seen.size(), 5u);
}

TEST(Town, SizesComeWithinTenPercentOfWhatIsAskedFor) {
  const Folder folder("sizes");
  TownOptions options;
  size_for_triangles(options, 150000);
  const TownCounts triangles = write_town(options, folder.path());
  EXPECT_NEAR(static_cast<double>(triangles.triangles), 150000, 15000);
  size_for_buildings(options, 1500);
  const TownCounts buildings = write_town(options, folder.path());
  EXPECT_NEAR(static_cast<double>(buildings.buildings), 1500, 150);
}

TEST(Town, ImpossibleSizesAreUsageErrorsAndUnwritableFoldersErrors) {
  const Folder folder("bad");
  TownOptions options = small();
  options.columns = 0;
  EXPECT_THROW(write_town(options, folder.path()), UsageError);
  options = small();
  options.hills_m = -1;
  EXPECT_THROW(write_town(options, folder.path()), UsageError);
  std::ofstream(folder.path()) << "a file where the folder should be";
  EXPECT_THROW(write_town(small(), folder.path()), Error);
}

}  // namespace
}  // namespace nightcity::town
