// A bake in parts gives the bytes of the whole bake, whatever the number of parts and the order in
// which they are named; a part is made once, and again where its recipe or inputs have changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/bake/bake.h"
#include "tools/bake/parts/bake_part.h"
#include "tools/bake/parts/part_file.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

using namespace test;

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST(Parts, AnyNumberOfThemGivesTheBytesOfTheWholeBake) {
  const TempFolder folder;
  town::TownOptions options;
  options.columns = options.rows = 2;
  town::write_town(options, folder.path());
  expect_parts_as_whole(folder / "town.toml", folder.path(), {1, 2, 3, 16});
}

// The part that reads a file counts what the file does not say.
TEST(Parts, BuildingsOfAMapAreCountedAsInTheWholeBake) {
  const TempFolder folder;
  std::string map = "<osm version=\"0.6\">\n";
  constexpr int houses = 9;
  std::string ways;
  for (int house = 0; house < houses; ++house) {
    std::string way = "<way id=\"" + std::to_string(1 + house) + "\">";
    for (int corner = 0; corner < 4; ++corner) {
      const int node = 1 + 4 * house + corner;
      const double lat = 48 + 0.0002 * (corner == 1 || corner == 2);
      const double lon = 11 + 0.001 * house + 0.0002 * (corner > 1);
      map += "<node id=\"" + std::to_string(node) + "\" lat=\"" + std::to_string(lat) +
             "\" lon=\"" + std::to_string(lon) + "\"/>\n";
      way += "<nd ref=\"" + std::to_string(node) + "\"/>";
    }
    way += "<nd ref=\"" + std::to_string(1 + 4 * house) + "\"/>";
    ways += way + "<tag k=\"building\" v=\"yes\"/></way>\n";
  }
  write(folder / "map.osm", map + ways + "</osm>\n");
  write(folder / "map.toml", "[osm]\nfiles = [\"map.osm\"]\n");
  expect_parts_as_whole(folder / "map.toml", folder.path(), {3});
  const nlohmann::json report = report_of(folder / "3");
  EXPECT_EQ(report["citygml"]["assumed"]["height of a building that the map does not say"], houses);
}

TEST(Parts, FilesOfACityMayBeNamedInAnyOrder) {
  const TempFolder folder;
  for (const int n : {0, 1, 2}) {
    town::TownOptions options;
    options.columns = options.rows = 1;
    options.seed = static_cast<std::uint64_t>(n) + 1;
    options.origin_east_m += 400 * n;
    const fs::path town = folder / ("town" + std::to_string(n));
    town::write_town(options, town);
  }
  const auto recipe = [&](const char* name, const char* files) {
    write(folder / name, "[city]\nfiles = [" + std::string(files) + "]\n[osm]\n" +
                             "files = [\"town0/town.osm\"]\n");
    return folder / name;
  };
  const fs::path straight =
      recipe("a.toml", R"("town0/town.gml", "town1/town.gml", "town2/town.gml")");
  const fs::path turned =
      recipe("b.toml", R"("town2/town.gml", "town0/town.gml", "town1/town.gml")");
  expect_parts_as_whole(straight, folder.path(), {1, 2, 5});
  EXPECT_TRUE(bake_whole(turned, folder / "turned") == Baked(folder / "whole"));
}

// Objects that two files share are taken from the first, whichever parts the files are in; without
// a map, streets come from the model's roads.
TEST(Parts, SharedObjectsAndStreetsOfTheModelAreThoseOfTheWholeBake) {
  const TempFolder folder;
  town::TownOptions options;
  options.columns = options.rows = 1;
  town::write_town(options, folder.path());
  const std::string town = bytes_of(folder / "town.gml");
  write(folder / "again.gml", town);
  write(folder / "twice.toml", "[city]\nfiles = [\"town.gml\", \"again.gml\"]\n[traffic]\n");
  expect_parts_as_whole(folder / "twice.toml", folder.path(), {1, 2, 3, 7});
}

std::string house(int n, const std::string& polygons) {
  return member("<bldg:Building gml:id=\"h" + std::to_string(n) + "\">" +
                boundary("RoofSurface", polygons) + "</bldg:Building>");
}

std::string roof(int n) {
  const std::string x = std::to_string(391000 + 20 * n), e = std::to_string(391010 + 20 * n);
  return surface_member(polygon("roof" + std::to_string(n), x + " 5819000 9 " + e + " 5819000 9 " +
                                                                e + " 5819010 9 " + x +
                                                                " 5819010 9 " + x + " 5819000 9"));
}

// Returns a city of some 300 kB, in which `extra(n)` stands behind the house of that number.
std::string many_houses(const std::function<std::string(int)>& extra) {
  std::string members;
  for (int n = 0; n < 700; ++n) members += house(n, roof(n)) + extra(n);
  return city_model(members);
}

class PartsOfAwkwardFiles : public testing::Test {
 protected:
  void expect_as_whole(const std::string& gml) {
    write(folder_ / "city.gml", gml);
    write(folder_ / "city.toml", "[city]\nfiles = [\"city.gml\"]\n");
    expect_parts_as_whole(folder_ / "city.toml", folder_.path(), {2, 5, 40});
  }
  TempFolder folder_;
};

TEST_F(PartsOfAwkwardFiles, MembersInCommentsAreNoMembers) {
  expect_as_whole(many_houses([](int n) {
    return n % 3 ? std::string() : "<!-- once\n" + house(1000 + n, roof(n)) + " -->\n";
  }));
}

TEST_F(PartsOfAwkwardFiles, MembersThatLinkToOthersAreReadWithThem) {
  expect_as_whole(many_houses([](int n) {
    return n % 50 ? std::string() : house(1000 + n, xlink_member("roof" + std::to_string(699 - n)));
  }));
}

TEST_F(PartsOfAwkwardFiles, ColoursThatStandBesideMembersReachAllOfThem) {
  std::string gml = many_houses([](int) { return std::string(); });
  const std::string end = "</core:CityModel>";
  gml.insert(
      gml.find(end),
      "<app:appearanceMember><app:Appearance><app:surfaceDataMember><app:X3DMaterial>"
      "<app:diffuseColor>0.9 0.1 0.1</app:diffuseColor><app:target>#roof3</app:target>"
      "</app:X3DMaterial></app:surfaceDataMember></app:Appearance></app:appearanceMember>\n");
  expect_as_whole(gml);
}

// Names of other CRSs are learnt in the order of the files.
TEST_F(PartsOfAwkwardFiles, GeometriesAreAlsoPlacedByTheirOwnCrs) {
  expect_as_whole(many_houses([](int n) {
    std::string other = house(1000 + n, roof(n));
    other.replace(other.find("<gml:MultiSurface>"), 18,
                  "<gml:MultiSurface srsName=\"EPSG:25832\">");
    return n == 77 || n == 601 ? other : std::string();
  }));
}

// Without ids, objects are named by their line in the file, from which their windows are drawn.
TEST_F(PartsOfAwkwardFiles, ObjectsWithoutIdsKeepTheirLines) {
  std::string gml = many_houses([](int) { return std::string("\n\n"); });
  for (std::size_t at = 0; (at = gml.find(" gml:id=\"h", at)) != std::string::npos;)
    gml.erase(at, gml.find('"', at + 10) + 1 - at);
  expect_as_whole(gml);
}

// An error in a file names its line, also by way of parts.
TEST(Parts, ABrokenFileIsAnErrorAtItsLine) {
  const TempFolder folder;
  std::string gml = many_houses([](int) { return std::string(); });
  const std::size_t at = gml.find("<bldg:Building gml:id=\"h600\"");
  gml.replace(at, 5, "<<<<<");
  write(folder / "city.gml", gml);
  write(folder / "city.toml", "[city]\nfiles = [\"city.gml\"]\n");
  const auto message_of = [](const std::function<void()>& act) {
    try {
      act();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string whole =
      message_of([&] { bake(read_recipe(folder / "city.toml"), folder / "whole"); });
  const std::string parts = message_of([&] {
    make_parts(folder / "city.toml", 4, folder / "parts");
    merge_parts({folder / "parts"}, {}, folder / "parts", "test");
  });
  EXPECT_NE(whole.find("city.gml:"), std::string::npos) << whole;
  EXPECT_EQ(parts.substr(parts.find("city.gml:")), whole.substr(whole.find("city.gml:")));
}

class SmallTown : public testing::Test {
 protected:
  SmallTown() {
    town::TownOptions options;
    options.columns = options.rows = 1;
    town::write_town(options, folder_.path());
    recipe_ = folder_ / "town.toml";
    out_ = folder_ / "out";
  }
  void expect_merge_refuses(const std::vector<fs::path>& named, const std::string& text) {
    try {
      merge_parts(named, {}, out_, "test");
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(out_ / "city.glb"));
  }
  TempFolder folder_;
  fs::path recipe_, out_;
};

TEST_F(SmallTown, APartIsMadeOnceAndAgainWhenSomethingHasChanged) {
  EXPECT_FALSE(make_part(recipe_, 1, 2, out_).was_done);
  EXPECT_TRUE(make_part(recipe_, 1, 2, out_).was_done);
  EXPECT_FALSE(make_part(recipe_, 2, 2, out_).was_done);
  merge_parts({out_}, {}, out_, "test");
  fs::remove(out_ / "city.glb");

  std::ofstream(recipe_, std::ios::app) << "[night]\ntime = \"23:00\"\n";
  expect_merge_refuses({out_}, "made from another recipe or from inputs that have changed since");
  EXPECT_FALSE(make_part(recipe_, 1, 2, out_).was_done);
  std::ofstream(folder_ / "town.osm", std::ios::app) << "\n";
  EXPECT_FALSE(make_part(recipe_, 1, 2, out_).was_done);
  std::ofstream(folder_ / "town.gml", std::ios::app) << "\n";
  EXPECT_FALSE(make_part(recipe_, 1, 2, out_).was_done);
  EXPECT_TRUE(make_part(recipe_, 1, 2, out_).was_done);
}

TEST_F(SmallTown, APartIsMadeAgainWhenAPictureBesideTheModelHasChanged) {
  const auto recipe = [&](const char* name, const std::string& textures) {
    write(folder_ / name, "[city]\nfiles = [\"town.gml\"]\n" + textures);
    return folder_ / name;
  };
  const fs::path with = recipe("with.toml", "textures = \"atlas\"\n"),
                 without = recipe("without.toml", "");
  fs::create_directory(folder_ / "appearance");
  write(folder_ / "appearance" / "wall.JPG", "one");
  EXPECT_FALSE(make_part(with, 1, 2, folder_ / "a").was_done);
  EXPECT_FALSE(make_part(without, 1, 2, folder_ / "b").was_done);
  EXPECT_TRUE(make_part(with, 1, 2, folder_ / "a").was_done);
  write(folder_ / "appearance" / "wall.JPG", "another");
  EXPECT_FALSE(make_part(with, 1, 2, folder_ / "a").was_done);
  EXPECT_TRUE(make_part(without, 1, 2, folder_ / "b").was_done) << "it reads no pictures";
  EXPECT_TRUE(make_part(with, 1, 2, folder_ / "a").was_done);
}

TEST_F(SmallTown, MissingAndDamagedPartsAreNamed) {
  expect_merge_refuses({folder_.path()}, "no part of a bake");
  make_part(recipe_, 1, 3, out_);
  make_part(recipe_, 3, 3, out_);
  expect_merge_refuses({out_}, "not all parts of 3 are there: missing: 2;");
  const fs::path part = make_part(recipe_, 2, 3, out_).file;
  std::string bytes = bytes_of(part);
  write(part, bytes.substr(0, bytes.size() - 1));
  expect_merge_refuses({out_}, "is damaged or cut off");
  EXPECT_FALSE(make_part(recipe_, 2, 3, out_).was_done);
  bytes = bytes_of(part);
  bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
  write(part, bytes);
  expect_merge_refuses({out_}, "is damaged or cut off");
}

TEST_F(SmallTown, PartsMayBeNamedOneByOneInAnyOrder) {
  const Baked whole = bake_whole(recipe_, folder_ / "whole");
  std::vector<fs::path> parts;
  for (const std::uint32_t number : {2u, 3u, 1u})
    parts.push_back(make_part(recipe_, number, 3, folder_ / std::to_string(number)).file);
  merge_parts(parts, {}, out_, "test");
  EXPECT_TRUE(Baked(out_) == whole);
  make_parts(recipe_, 2, out_);  // another set beside it
  parts.push_back(out_);
  merge_parts(parts, {}, out_, "test");
  EXPECT_TRUE(Baked(out_) == whole);
}

TEST(Share, IsANumberOfACount) {
  EXPECT_EQ(parse_share("3/64"), (Share{3, 64}));
  for (const char* wrong :
       {"", "3", "0/4", "5/4", "-1/4", "1/4 ", "a/b", "1/0", "1/100001", "1//2"})
    EXPECT_FALSE(parse_share(wrong)) << wrong;
}

// Whatever the number of shares, each byte of a file that can be cut is in one piece.
TEST(Share, PiecesMeet) {
  const TempFolder folder;
  write(folder / "city.gml", many_houses([](int) { return std::string("\n"); }));
  CityInputs inputs;
  inputs.files = {folder / "city.gml"};
  const CitySurvey survey = survey_city(inputs);
  ASSERT_TRUE(survey.cuts.at(0));
  for (const std::uint32_t count : {2u, 3u, 64u, 5000u}) {
    std::uint64_t at = survey.cuts[0]->head_end;
    for (std::uint32_t number = 1; number <= count; ++number)
      for (const SharePiece& piece : find_pieces(inputs, survey, {number, count})) {
        ASSERT_TRUE(piece.piece);
        EXPECT_EQ(piece.piece->begin, at);
        at = piece.piece->end;
      }
    EXPECT_EQ(at, survey.sizes[0]);
  }
}

}  // namespace
}  // namespace nightcity::bake
