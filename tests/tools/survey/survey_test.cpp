// `nightbake new` tells each file for what it is, and the recipe that it writes bakes.
#include "tools/survey/survey.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <algorithm>

#include "formats/error.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/bake/bake.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/nightbake/sample_city.h"
#include "tools/survey/new_recipe.h"
#include "tools/survey/plan.h"

namespace nightcity::survey {
namespace {

using namespace test;

const SurveyedFile& find(const std::vector<SurveyedFile>& files, const std::string& name) {
  const auto found = std::find_if(files.begin(), files.end(), [&](const SurveyedFile& file) {
    return file.path.filename() == name;
  });
  if (found == files.end()) throw Error(name, "was not looked at");
  return *found;
}

bool mentions(const std::vector<std::string>& texts, const std::string& part) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const std::string& text) { return text.find(part) != text.npos; });
}

const char* small_map =
    "<osm version=\"0.6\"><node id=\"1\" lat=\"52.510075\" lon=\"13.393876\"/>"
    "<node id=\"2\" lat=\"52.510487\" lon=\"13.394451\"/><node id=\"3\" lat=\"52.510124\" "
    "lon=\"13.394169\"><tag k=\"highway\" v=\"street_lamp\"/></node><way id=\"1\"><nd ref=\"1\"/>"
    "<nd ref=\"2\"/><tag k=\"highway\" v=\"residential\"/></way></osm>";

const char* lamps =
    "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":"
    "{\"PoleID\":\"a\",\"Mount_Ht\":8,\"WATTS\":40,\"note\":\"x\"},\"geometry\":{\"type\":"
    "\"Point\",\"coordinates\":[13.394231,52.510439]}}]}";

TEST(Survey, EachFileIsToldForWhatItIs) {
  const TempFolder folder;
  write_text(folder / "cube.gml", sample_gml());
  write_text(folder / "map.osm", small_map);
  write_text(folder / "lamps.geojson", lamps);
  write_text(folder / "page.html", "<!DOCTYPE html><html></html>");
  write_text(folder / "roof.png", "\x89PNG");
  write_text(folder / ".hidden.gml", sample_gml());
  const auto files = survey_files({folder.path()});
  ASSERT_EQ(files.size(), 5u);
  EXPECT_EQ(find(files, "cube.gml").use, Use::city);
  EXPECT_TRUE(find(files, "cube.gml").has_crs);
  EXPECT_NE(find(files, "cube.gml").what.find("25833"), std::string::npos);
  EXPECT_EQ(find(files, "map.osm").use, Use::map);
  EXPECT_EQ(find(files, "map.osm").lamps, 1u);
  EXPECT_EQ(find(files, "roof.png").use, Use::companion);
  EXPECT_EQ(find(files, "page.html").use, Use::nothing);
  EXPECT_NE(find(files, "page.html").what.find("web page"), std::string::npos);
  const SurveyedFile& inventory = find(files, "lamps.geojson");
  ASSERT_EQ(inventory.use, Use::inventory);
  EXPECT_EQ(inventory.inventory->id, "PoleID");
  EXPECT_EQ(inventory.inventory->columns.at("height"), "Mount_Ht");
  EXPECT_EQ(inventory.inventory->columns.at("watts"), "WATTS");
  EXPECT_EQ(inventory.inventory->columns.size(), 2u);
  EXPECT_THROW(survey_files({folder / "none"}), Error);
}

TEST(Survey, OfSeveralLayersTheOneOfLampsIsTaken) {
  const TempFolder folder;
  gdal::register_drivers();
  {
    GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GPKG")->Create(
        (folder / "city.gpkg").c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    ASSERT_TRUE(set);
    OGRSpatialReference crs;
    crs.importFromEPSG(25833);
    for (const char* name : {"benches", "trees", "street_lights", "wells"}) {
      OGRLayer* layer = set->CreateLayer(name, &crs, wkbPoint, nullptr);
      OGRFieldDefn height("height", OFTReal);
      layer->CreateField(&height);
      OGRFeatureUniquePtr row(OGRFeature::CreateFeature(layer->GetLayerDefn()));
      OGRPoint point(391000, 5819000);
      row->SetGeometry(&point);
      ASSERT_EQ(layer->CreateFeature(row.get()), OGRERR_NONE);
    }
  }
  const auto files = survey_files({folder / "city.gpkg"});
  ASSERT_EQ(files.at(0).use, Use::inventory) << files[0].what;
  EXPECT_EQ(files[0].inventory->layer, "street_lights");
}

TEST(Survey, PointsThatNothingCallsLampsAreNone) {
  const TempFolder folder;
  const std::string point =
      "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{"
      "\"height\":9},"
      "\"geometry\":{\"type\":\"Point\",\"coordinates\":[13.394231,52.510439]}}]}";
  write_text(folder / "trees.geojson", point);
  write_text(folder /
                 "Stra\xC3\x9F"
                 "enlaternen.geojson",
             point);
  const auto files = survey_files({folder.path()});
  EXPECT_EQ(find(files, "trees.geojson").use, Use::nothing);
  EXPECT_NE(find(files, "trees.geojson").what.find("speaks of lamps"), std::string::npos);
  EXPECT_EQ(find(files,
                 "Stra\xC3\x9F"
                 "enlaternen.geojson")
                .use,
            Use::inventory);
}

TEST(Survey, LuminairesAreRead) {
  const TempFolder folder;
  write_text(folder / "a.ies", "TILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n100 100\n");
  write_text(folder / "b.ies", "hello\n");
  const auto files = survey_files({folder.path()});
  EXPECT_EQ(find(files, "a.ies").use, Use::luminaire);
  EXPECT_NE(find(files, "a.ies").what.find("628 lm"), std::string::npos);
  EXPECT_EQ(find(files, "b.ies").use, Use::nothing);
}

TEST(Survey, ATableThatCannotBePlacedIsToldForThat) {
  const TempFolder folder;
  write_text(
      folder / "lamps.geojson",
      "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{},"
      "\"geometry\":{\"type\":\"Point\",\"coordinates\":[391000,5819000]}}]}");
  const auto files = survey_files({folder / "lamps.geojson"});
  EXPECT_EQ(files.at(0).use, Use::nothing);
  EXPECT_NE(files[0].what.find("say the CRS"), std::string::npos) << files[0].what;
}

TEST(Survey, ABoxMayLieAcrossTheAntimeridian) {
  Box fiji;
  fiji.add({179.9, -17});
  fiji.add({-179.8, -16});
  EXPECT_NEAR(fiji.greatest.x - fiji.least.x, 0.3, 1e-9);
  Box east;
  east.add({-179.7, -16.5});
  EXPECT_TRUE(fiji.is_near(east, 0.2));
  EXPECT_TRUE(east.is_near(fiji, 0.2));
  Box greenwich;
  greenwich.add({0, -16.5});
  EXPECT_FALSE(fiji.is_near(greenwich, 0.2));
}

TEST(Survey, TheRecipeBakesWithEveryFileInIt) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "my \"data\"");
  const std::filesystem::path data = folder / "my \"data\"";
  write_text(data / "cube.gml", sample_gml());
  write_text(data / "map.osm", small_map);
  write_text(data / "lamps.geojson", lamps);
  const auto files = survey_files({data});
  const Plan plan = make_plan(files);
  EXPECT_TRUE(plan.left_out.empty());
  EXPECT_FALSE(mentions(plan.missing, "lamp")) << "there are some";
  std::filesystem::create_directory(folder / "city");
  write_text(folder / "city" / "recipe.toml", make_recipe_text(plan, folder / "city"));
  const bake::BakeReport report =
      bake::bake(bake::read_recipe(folder / "city" / "recipe.toml"), folder / "out");
  EXPECT_EQ(report.city.objects.at("building"), 1u);
  ASSERT_EQ(report.lights.lamps.inventories.size(), 1u);
  EXPECT_EQ(report.lights.lamps.inventories[0].lamps, 1u);
  EXPECT_EQ(report.lights.lamps.inventories[0].columns.at("watts"), 1u);
  EXPECT_EQ(report.lights.lamps.dark, "");
}

TEST(Survey, WhatLiesElsewhereOrNowhereIsLeftOutWithItsReason) {
  const TempFolder folder;
  write_text(folder / "cube.gml", sample_gml());
  std::string far = small_map;
  for (std::size_t at = 0; (at = far.find("lon=\"13", at)) != std::string::npos; ++at)
    far.replace(at, 7, "lon=\"23");
  write_text(folder / "far.osm", far);
  std::string nowhere = sample_gml();
  for (std::size_t at = 0; (at = nowhere.find("srsName", at)) != std::string::npos; ++at)
    nowhere.replace(at, 7, "srsNone");
  write_text(folder / "nowhere.gml", nowhere);
  const auto files = survey_files({folder.path()});
  const Plan plan = make_plan(files);
  EXPECT_EQ(plan.cities.size(), 1u);
  EXPECT_TRUE(plan.maps.empty());
  ASSERT_EQ(plan.left_out.size(), 2u);
  EXPECT_TRUE(mentions(plan.missing, "overpass-api.de/api/map?bbox=13."));
  const auto alone = survey_files({folder / "nowhere.gml", folder / "far.osm"});
  const Plan without = make_plan(alone);
  EXPECT_EQ(without.cities.size(), 1u);
  EXPECT_TRUE(without.maps.empty()) << "a map has no place under it";
  EXPECT_TRUE(mentions(without.missing, "CRS"));
  write_text(folder / "recipe.toml", make_recipe_text(without, folder.path()));
  const bake::BakeReport report =
      bake::bake(bake::read_recipe(folder / "recipe.toml"), folder / "out");
  EXPECT_NE(report.lights.lamps.dark.find("names no CRS"), std::string::npos)
      << report.lights.lamps.dark;
}

std::string with_all(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size())
    text.replace(at, word.size(), by);
  return text;
}

// The first by name lies in another country than the map and the table of lamps.
TEST(Survey, OfModelsInTwoPlacesThoseAtTheMapAreTaken) {
  const TempFolder folder;
  write_text(folder / "a.gml", with_all(sample_gml(), "25833", "25831"));  // 12 degrees west
  write_text(folder / "b.gml", sample_gml());
  const auto models = survey_files({folder.path()});
  const Plan by_name = make_plan(models);
  ASSERT_EQ(by_name.cities.size(), 1u);
  EXPECT_EQ(by_name.cities[0]->path.filename(), "a.gml");
  ASSERT_EQ(by_name.left_out.size(), 1u);
  EXPECT_NE(by_name.left_out[0].second.find("the first of its kind"), std::string::npos);

  write_text(folder / "map.osm", small_map);
  const auto with_map = survey_files({folder.path()});
  const Plan by_map = make_plan(with_map);
  ASSERT_EQ(by_map.cities.size(), 1u);
  EXPECT_EQ(by_map.cities[0]->path.filename(), "b.gml");
  EXPECT_EQ(by_map.maps.size(), 1u);
  ASSERT_EQ(by_map.left_out.size(), 1u);
  EXPECT_EQ(by_map.left_out[0].first->path.filename(), "a.gml");
  EXPECT_NE(by_map.left_out[0].second.find("what goes with the others"), std::string::npos);

  std::filesystem::remove(folder / "map.osm");
  write_text(folder / "c.gml", sample_gml());
  const auto three = survey_files({folder.path()});
  const Plan by_most = make_plan(three);
  ASSERT_EQ(by_most.cities.size(), 2u);
  EXPECT_EQ(by_most.cities[0]->path.filename(), "b.gml");
  EXPECT_NE(by_most.left_out.at(0).second.find("most of its kind"), std::string::npos);
}

TEST(Survey, OfMapsInTwoPlacesThoseAtTheTableOfLampsAreTaken) {
  const TempFolder folder;
  write_text(folder / "a.osm", with_all(small_map, "lon=\"13", "lon=\"23"));
  write_text(folder / "b.osm", small_map);
  write_text(folder / "lamps.geojson", lamps);
  const auto files = survey_files({folder.path()});
  const Plan plan = make_plan(files);
  ASSERT_EQ(plan.maps.size(), 1u);
  EXPECT_EQ(plan.maps[0]->path.filename(), "b.osm");
  EXPECT_EQ(plan.inventories.size(), 1u);
}

TEST(Survey, AMapAloneIsACityAndNothingIsNone) {
  const TempFolder folder;
  write_text(folder / "map.osm", small_map);
  const auto files = survey_files({folder / "map.osm"});
  const Plan plan = make_plan(files);
  EXPECT_FALSE(plan.is_empty());
  EXPECT_TRUE(mentions(plan.missing, "city model"));
  write_text(folder / "page.html", "<html/>");
  const auto none = survey_files({folder / "page.html"});
  EXPECT_TRUE(make_plan(none).is_empty());
}

TEST(Survey, RealCitiesBakeFromTheRecipesMadeForThem) {
  for (const char* name : {"berlin", "munich", "karlsruhe", "vienna", "cityjson"}) {
    REAL_DATA(data, name);
    const TempFolder folder;
    const auto files = survey_files({data});
    write_text(folder / "recipe.toml", make_recipe_text(make_plan(files), folder.path()));
    bake::Recipe recipe = bake::read_recipe(folder / "recipe.toml");
    recipe.windows.lit = false;
    const bake::BakeReport report = bake::bake(recipe, folder / "out");
    EXPECT_GT(report.city.objects.at("building"), 0u) << name;
  }
}

}  // namespace
}  // namespace nightcity::survey
