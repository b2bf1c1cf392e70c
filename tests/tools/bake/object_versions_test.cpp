// Tests that a city that is delivered in several levels of detail has each object once, in the best
// of them, whatever the order of its files.
#include "tools/bake/city/object_versions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tools/bake/bake.h"
#include "tools/bake/city/city.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::bake {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;
using test::write_text;

std::string replace_all(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

// The sample has its cube in LoD2, from 391000 5819000 on.
std::string coarse_city() {
  const std::string text = replace_all(test::sample_gml(), "lod2", "lod1");
  // Another first corner, since no other rule is to find that both are the same.
  return replace_all(text, "391000", "391000.5");
}

std::map<std::string, int> read_levels(const CityInputs& given, CityReport& report) {
  class Levels final : public CityConsumer {
   public:
    Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override {
      return [this, prepared](bool) { lods[prepared->object.id] += 10 + prepared->object.lod; };
    }
    std::map<std::string, int> lods;  // 10 for each time that an object comes, and its LoD
  };
  CityInputs inputs = given;
  const TempFolder folder;
  return use_best_levels(inputs, [&] {
    City city(inputs, folder / "scratch");
    Levels levels;
    report = city.read({&levels}, {});
    return levels.lods;
  });
}

class ObjectLevels : public testing::Test {
 protected:
  std::map<std::string, int> read(const std::vector<fs::path>& files, int max_lod = 2) {
    CityInputs inputs;
    inputs.files = files;
    inputs.read.max_lod = max_lod;
    return read_levels(inputs, report_);
  }
  TempFolder folder_;
  CityReport report_;
};

TEST_F(ObjectLevels, OfTwoFilesTheBetterOneWinsInAnyOrder) {
  write_text(folder_ / "1.gml", coarse_city());
  write_text(folder_ / "2.gml", test::sample_gml());
  for (const auto& [first, second] : {std::pair("1.gml", "2.gml"), std::pair("2.gml", "1.gml")}) {
    EXPECT_EQ(read({folder_ / first, folder_ / second}).at("cube"), 12) << first;
    EXPECT_EQ(report_.left_out.at("in a lower level of detail than the same elsewhere"), 1u);
    // The best is the highest that the recipe allows.
    EXPECT_EQ(read({folder_ / first, folder_ / second}, 1).at("cube"), 11) << first;
  }
}

TEST_F(ObjectLevels, OfOneArchiveToo) {
  for (const bool coarse_first : {true, false}) {
    const fs::path path = folder_ / (coarse_first ? "a.zip" : "b.zip");
    test::pack_zip(path, {{coarse_first ? "lod1/a.gml" : "lod3/a.gml", coarse_city()},
                          {"lod2/a.gml", test::sample_gml()}});
    EXPECT_EQ(read({path}).at("cube"), 12);
  }
}

// Programs number the objects of each file anew.
TEST_F(ObjectLevels, ObjectsOfOneIdInTwoPlacesAreTwo) {
  write_text(folder_ / "1.gml", replace_all(coarse_city(), "391", "392"));
  write_text(folder_ / "2.gml", test::sample_gml());
  EXPECT_EQ(read({folder_ / "1.gml", folder_ / "2.gml"}).at("cube"), 23);
}

TEST_F(ObjectLevels, ABakeHasTheBetterOneAlone) {
  write_text(folder_ / "1.gml", coarse_city());
  write_text(folder_ / "2.gml", test::sample_gml());
  const auto triangles = [&](const std::vector<std::string>& names) {
    std::string files;
    for (const std::string& name : names) files += "\"" + name + "\",";
    write_text(folder_ / "r.toml", "[city]\nfiles = [" + files + "]\n");
    return bake(read_recipe(folder_ / "r.toml"), folder_ / "out").scene.triangles;
  };
  const auto one = triangles({"2.gml"});
  EXPECT_EQ(triangles({"1.gml", "2.gml"}), one);
  EXPECT_EQ(triangles({"2.gml", "1.gml"}), one);
}

ObjectVersion version(std::uint64_t number, int lod) {
  ObjectVersion one;
  one.id = 1;
  one.identity = one.contents = number;
  one.file = static_cast<std::uint32_t>(number);
  one.lod = static_cast<std::int8_t>(lod);
  one.box = {0, 0, 10, 10};
  return one;
}

TEST(ObjectVersions, AChainOfLevelsNeedsOneMoreRound) {
  const std::vector<ObjectVersion> files{version(1, 0), version(2, 1), version(3, 2),
                                         version(4, 1)};
  std::shared_ptr<const OutdatedVersions> known;
  for (int round = 0;; ++round) {
    ObjectVersions versions(known, 2);
    std::vector<int> taken;
    for (const ObjectVersion& one : files)
      if (!versions.take(one)) taken.push_back(one.lod);
    try {
      versions.finish();
      EXPECT_EQ(round, 1);
      EXPECT_EQ(taken, std::vector<int>{2});
      return;
    } catch (const BetterLevelsFollow& found) {
      ASSERT_LT(round, 5);
      known = found.outdated();
    }
  }
}

// Ids that a whole city shares would cost a comparison of each with each.
TEST(ObjectVersions, ManyObjectsOfOneIdCostNoMoreThanOthers) {
  ObjectVersions versions(nullptr, 2);
  for (std::uint64_t i = 1; i <= 200'000; ++i) {
    ObjectVersion one = version(i, 2);
    const auto at = static_cast<float>(20 * i);
    one.box = {at, 0, at + 10, 10};
    EXPECT_EQ(versions.take(one), nullptr);
  }
}

}  // namespace
}  // namespace nightcity::bake
