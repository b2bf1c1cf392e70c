// Tests nightbake readers from outside.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/data.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;
using test::Outcome;
using test::TempFolder;

Outcome readers(const std::string& options, const std::filesystem::path& file) {
  return test::run_program("nightbake", "readers " + options + " '" + file.string() + "'");
}

// libcitygml 2.4.3 reads nothing of this building, because it skips LoD0.
std::string footprint_city() {
  using namespace test;
  return city_model(member(building("both")) +
                    member("<bldg:Building gml:id=\"flat\"><bldg:lod0FootPrint>" +
                           multi_surface(surface_member(polygon("p", square_at_zero))) +
                           "</bldg:lod0FootPrint></bldg:Building>"));
}

TEST(ReadersCommand, SaysThatTheReadersAgreeAndOnWhat) {
  const TempFolder folder;
  test::write_text(folder / "a.gml", test::city_model(test::member(test::building("A"))));
  const Outcome words = readers("", folder / "a.gml");
  EXPECT_EQ(words.exit_code, 0) << words.err;
  EXPECT_NE(words.out.find("agree: 1 objects, 3 polygons"), std::string::npos) << words.out;
  const Outcome all = readers("--all", folder / "a.gml");
  for (const char* type : {"building", "wall", "roof", "ground"})
    EXPECT_NE(all.out.find(type), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("differ"), std::string::npos) << all.out;
}

TEST(ReadersCommand, ShowsWhereTheyDisagreeByTypeAndInNumbers) {
  const TempFolder folder;
  test::write_text(folder / "a.gml", footprint_city());
  const Outcome words = readers("", folder / "a.gml");
  EXPECT_EQ(words.exit_code, 0) << words.err;
  EXPECT_NE(words.out.find("ground"), std::string::npos) << words.out;
  EXPECT_NE(words.out.find("differ"), std::string::npos) << words.out;
  EXPECT_EQ(words.out.find("roof"), std::string::npos) << "they agree on it\n" << words.out;

  const json one = json::parse(readers("--json", folder / "a.gml").out).at(0);
  EXPECT_FALSE(one.at("agree").get<bool>());
  const json& ground = one.at("surfaces").at("ground");
  EXPECT_EQ(ground.at("stream").at("polygons"), 2);
  EXPECT_EQ(ground.at("libcitygml").at("polygons"), 1);
  EXPECT_EQ(ground.at("stream").at("area"), 2.0);
  EXPECT_FALSE(one.at("libcitygml").at("skipped").empty()) << "what is lost has a name";
}

TEST(ReadersCommand, TakesFoldersAndRefusesWhatIsNoCity) {
  const TempFolder folder;
  test::write_text(folder / "a.gml", footprint_city());
  test::write_text(folder / "b.gml", test::city_model(test::member(test::building("B"))));
  const Outcome both = readers("", folder.path());
  EXPECT_NE(both.out.find("2 files, the readers disagree on 1"), std::string::npos) << both.out;
  test::write_text(folder / "c.gml", "<a/>");
  EXPECT_EQ(readers("", folder / "c.gml").exit_code, 1);
  EXPECT_EQ(readers("", folder / "absent.gml").exit_code, 1);
  EXPECT_EQ(test::run_program("nightbake", "readers").exit_code, 2);
}

}  // namespace
}  // namespace nightcity::nightbake
