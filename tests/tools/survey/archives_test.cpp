// `nightbake new` tells archives for what they hold.
#include <gtest/gtest.h>
#include <zip.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/pack_archive.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/survey/survey.h"

namespace nightcity::survey {
namespace {

using test::TempFolder;

// A grid of 3 x 3 heights around the city, in its coordinates.
constexpr const char* small_grid =
    "ncols 3\nnrows 3\nxllcorner 390900\nyllcorner 5818900\ncellsize 100\n"
    "35 35 35\n35 35 35\n35 35 35\n";

TEST(Survey, AnArchiveOfHeightsIsOneWhateverLiesBeside) {
  const TempFolder folder;
  zip_t* zip = zip_open((folder / "dgm1.zip").c_str(), ZIP_CREATE, nullptr);
  const std::string_view index = "tile,lon,lat\na,13.4,52.5\n";
  for (const auto& [name, text] : {std::pair<const char*, std::string_view>{"dgm1.asc", small_grid},
                                   {"index.csv", index},
                                   {"meta.xml", "<metadata/>"}})
    zip_file_add(zip, name, zip_source_buffer(zip, text.data(), text.size(), 0), 0);
  ASSERT_EQ(zip_close(zip), 0);
  const auto files = survey_files({folder / "dgm1.zip"});
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].use, Use::elevation) << files[0].what;
  EXPECT_NE(files[0].what.find("one every 100 m"), std::string::npos) << files[0].what;
}

// A city, a map, a table, heights and photometry in each form, as `nightbake new` is given them.
TEST(Survey, EveryFormIsToldForWhatItHolds) {
  const TempFolder folder;
  const std::string city = test::city_model(test::member(test::building("a"))),
                    map =
                        "<osm version='0.6'><node id='1' lat='52.5' lon='13.4'>"
                        "<tag k='highway' v='street_lamp'/></node></osm>",
                    lamps = "pole_id;lamp_type;lon;lat\na;LED;13.4;52.5\n",
                    ies =
                        "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n"
                        "100 0\n";
  struct Case {
    const char* name;
    std::string bytes;
    Use use;
  };
  const std::vector<Case> cases{{"a.gml", city, Use::city},
                                {"a.osm", map, Use::map},
                                {"a.csv", lamps, Use::inventory},
                                {"a.asc", small_grid, Use::elevation},
                                {"a.ies", ies, Use::luminaire}};
  const auto expect = [](const std::filesystem::path& path, const Case& c) {
    const auto files = survey_files({path});
    ASSERT_EQ(files.size(), 1u) << path;
    EXPECT_EQ(files[0].use, c.use) << path << " " << files[0].what;
  };
  for (const Case& c : cases) {
    for (const char* form : test::archive_forms) {
      const auto path = folder / ("delivery" + std::string(form));
      test::pack_archive(path, {{c.name, c.bytes}});
      expect(path, c);
    }
    for (const char* form : test::stream_forms) {
      const auto path = folder / (c.name + std::string(form));
      test::pack_stream(path, c.bytes);
      expect(path, c);
    }
  }
}

}  // namespace
}  // namespace nightcity::survey
