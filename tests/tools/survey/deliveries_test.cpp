// Folders of downloads hold tables without a CRS, texts, and archives of several kinds.
#include <gtest/gtest.h>

#include <string>

#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tools/cityjson/small_cityjson.h"
#include "tools/nightbake/sample_city.h"
#include "tools/survey/survey.h"

namespace nightcity::survey {
namespace {

using test::TempFolder;
using test::write_text;

constexpr const char* map_of_a_lamp =
    "<osm version=\"0.6\"><node id=\"1\" lat=\"52.5101\" lon=\"13.3941\">"
    "<tag k=\"highway\" v=\"street_lamp\"/></node></osm>";

SurveyedFile look_at(const TempFolder& folder, const std::string& name) {
  for (const SurveyedFile& file : survey_files({folder.path()}))
    if (file.path.filename() == name) return file;
  return {};
}

TEST(Deliveries, ATableWithoutACrsHasTheOneByWhichItLiesBesideTheOthers) {
  const TempFolder folder;
  const auto look = [&](const std::string& rows) {
    write_text(folder / "lampen.csv", "nr;rechtswert;hochwert\n" + rows);
    return look_at(folder, "lampen.csv");
  };
  write_text(folder / "cube.gml", test::sample_gml());
  const SurveyedFile of_city = look("1;391020,5;5819010,5\n");
  ASSERT_EQ(of_city.use, Use::inventory) << of_city.what;
  EXPECT_EQ(of_city.inventory->crs, "EPSG:25833");
  EXPECT_NEAR(of_city.box.least.y, 52.5101, 1e-3);
  EXPECT_NE(of_city.what.find("EPSG:25833 is assumed"), std::string::npos) << of_city.what;
  // Maps on the web have this for 13.3941 E, 52.5101 N.
  const SurveyedFile of_web = look("1;1491024;6893113\n");
  ASSERT_EQ(of_web.use, Use::inventory) << of_web.what;
  EXPECT_EQ(of_web.inventory->crs, "EPSG:3857");
  const SurveyedFile elsewhere = look("1;123456789;987654321\n");
  EXPECT_EQ(elsewhere.use, Use::nothing);
  EXPECT_NE(elsewhere.what.find("say the CRS"), std::string::npos) << elsewhere.what;
  std::filesystem::remove(folder / "cube.gml");
  write_text(folder / "map.osm", map_of_a_lamp);
  EXPECT_EQ(look("1;391020,5;5819010,5\n").inventory->crs, "EPSG:32633") << "the usual zone";
}

TEST(Deliveries, TextsAreTablesOrHeightsOrWordsForAReader) {
  const TempFolder folder;
  std::string heights;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      heights += std::to_string(391000 + 10 * j) + " " + std::to_string(5819000 + 10 * i) + " 35\n";
  write_text(folder / "dgm.txt", heights);
  write_text(folder / "laternen.txt", "nr\tlon\tlat\n1\t13.3941\t52.5101\n");
  write_text(folder / "readme.txt", "The data of the city.\nLicence: CC0\n");
  EXPECT_EQ(look_at(folder, "dgm.txt").use, Use::elevation);
  EXPECT_EQ(look_at(folder, "laternen.txt").use, Use::inventory);
  EXPECT_EQ(look_at(folder, "readme.txt").use, Use::companion);
}

TEST(Deliveries, AnArchiveHasEachUseOfItsContents) {
  const TempFolder folder;
  const auto look = [&](const std::vector<std::pair<std::string, std::string>>& entries) {
    test::pack_zip(folder / "all.zip", entries);
    std::string uses, what;
    for (const SurveyedFile& file : survey_files({folder / "all.zip"})) {
      EXPECT_EQ(file.path, folder / "all.zip");
      uses += file.use == Use::city        ? "city "
              : file.use == Use::map       ? "map "
              : file.use == Use::elevation ? "elevation "
              : file.use == Use::inventory ? "inventory "
                                           : "nothing ";
      what += file.what;
    }
    return std::pair(uses, what);
  };
  const std::pair<std::string, std::string> model{"a.gml", test::sample_gml()},
      map{"streets/m.osm", map_of_a_lamp},
      lamps{"lamps.csv", "lamp_id,lon,lat\n1,13.3941,52.5101\n"},
      trees{"trees.csv", "species,lon,lat\nTilia,13.3941,52.5101\n"},
      heights{"dem/h.asc",
              "ncols 2\nnrows 2\nxllcorner 391000\nyllcorner 5819000\ncellsize 50\n35 35\n35 35\n"},
      words{"terms.pdf", "%PDF"}, light{"l.ies", "IESNA:LM-63-1995"};
  EXPECT_EQ(look({model, map}).first, "city map ");
  EXPECT_EQ(look({model, map, lamps, heights, words}).first, "city map elevation inventory ");
  EXPECT_EQ(look({model, lamps}).first, "city inventory ");
  EXPECT_EQ(look({map, heights}).first, "map elevation ");
  EXPECT_EQ(look({heights, lamps}).first, "elevation inventory ");
  // A city model in JSON is no second table.
  const std::pair<std::string, std::string> cityjson{
      "b.json", test::city_json(test::object("a", "Building", test::solid()))},
      points{"lamps.json",
             "[{\"lamp_id\":1,\"lon\":13.3941,\"lat\":52.5101},{\"lamp_id\":2,\"lon\":13.3942,"
             "\"lat\":52.5102}]"};
  EXPECT_EQ(look({cityjson, lamps}).first, "city inventory ");
  EXPECT_EQ(look({cityjson, points}).first, "city inventory ");
  EXPECT_EQ(look({model, words}).first, "city ");
  EXPECT_EQ(look({model, trees}).first, "city ");
  for (const auto& all : {look({model, map, lamps, heights, words}), look({model, words})})
    EXPECT_EQ(all.second.find("unpack"), std::string::npos) << all.second;
  EXPECT_NE(look({model, map, trees}).second.find("unpack it for what else it holds: 1 .csv"),
            std::string::npos);
  EXPECT_NE(look({model, trees, light})
                .second.find("unpack it for what else it holds: l.ies (IES), 1 .csv"),
            std::string::npos);
}

TEST(Deliveries, LightsThatWereExportedAndTrafficLightsAreNoInventory) {
  const TempFolder folder;
  write_text(
      folder / "lights.csv",
      "light,kind,flux_lm,position_from,flux_from,lon,lat\n1,window,9,rule,rule,13.4,52.5\n");
  write_text(folder / "lichtsignalanlagen.csv", "nr,lon,lat\n1,13.3941,52.5101\n");
  write_text(folder / "Lichtpunkte.csv", "nr,lon,lat\n1,13.3941,52.5101\n");
  EXPECT_EQ(look_at(folder, "lights.csv").use, Use::nothing);
  EXPECT_NE(look_at(folder, "lights.csv").what.find("finished scene"), std::string::npos);
  EXPECT_EQ(look_at(folder, "lichtsignalanlagen.csv").use, Use::nothing);
  EXPECT_EQ(look_at(folder, "Lichtpunkte.csv").use, Use::inventory);
}

TEST(Deliveries, AMapInJsonIsOneAndABrokenOneNoTable) {
  const TempFolder folder;
  const std::string answer =
      "{\"version\":0.6,\"generator\":\"Overpass API\",\"elements\":[{\"type\":\"node\",\"id\":1,"
      "\"lat\":52.5101,\"lon\":13.3941,\"tags\":{\"highway\":\"street_lamp\"}}]";
  write_text(folder / "a.json", answer + "}");
  write_text(folder / "b.json", answer + ",\"remark\":\"runtime error: Query timed out\"}");
  EXPECT_EQ(look_at(folder, "a.json").use, Use::map);
  EXPECT_EQ(look_at(folder, "a.json").lamps, 1u);
  EXPECT_EQ(look_at(folder, "b.json").use, Use::nothing);
  EXPECT_NE(look_at(folder, "b.json").what.find("incomplete"), std::string::npos);
}

TEST(Deliveries, AFileIsTakenOnceAndByANameThatARecipeCanHold) {
  const TempFolder folder;
  write_text(folder / "map.osm", map_of_a_lamp);
  EXPECT_EQ(survey_files({folder.path(), folder / "map.osm", folder / "x/../map.osm"}).size(), 1u);
  write_text(folder /
                 "stra\xDF"
                 "e.osm",
             map_of_a_lamp);
  const auto files = survey_files({folder.path()});
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[1].use, Use::nothing);
  EXPECT_NE(files[1].what.find("rename it"), std::string::npos) << files[1].what;
}

}  // namespace
}  // namespace nightcity::survey
