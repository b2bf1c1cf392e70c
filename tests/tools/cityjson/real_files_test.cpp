// Every CityJSON of the data folder and the corpus is read, and every polygon is in the model or in
// the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "support/data.h"
#include "tools/cityjson/read_cityjson.h"

namespace nightcity::cityjson {
namespace {

// Counts the polygons by another parser: those of all geometries that have surfaces.
std::size_t polygons_in(const std::filesystem::path& file) {
  std::size_t count = 0;
  const std::function<void(const nlohmann::json&, int)> add = [&](const nlohmann::json& boundaries,
                                                                  int depth) {
    if (depth == 0) count += boundaries.size();
    if (depth > 0)
      for (const auto& child : boundaries) add(child, depth - 1);
  };
  std::ifstream in(file);
  nlohmann::json value;
  std::vector<nlohmann::json> templates;
  while ((in >> std::ws).peek() != EOF) {
    in >> value;
    if (value.contains("geometry-templates"))
      for (const auto& shape : value["geometry-templates"]["templates"]) templates.push_back(shape);
    const auto add_geometry = [&](const nlohmann::json& g) {
      const std::string type = g.value("type", "");
      if (type == "MultiSurface" || type == "CompositeSurface") add(g["boundaries"], 0);
      if (type == "Solid") add(g["boundaries"], 1);
      if (type == "MultiSolid" || type == "CompositeSolid") add(g["boundaries"], 2);
    };
    if (!value.contains("CityObjects") || !value["CityObjects"].is_object()) continue;
    for (const auto& [id, object] : value["CityObjects"].items())
      for (const auto& g : object.is_object() ? object.value("geometry", nlohmann::json::array())
                                              : nlohmann::json::array())
        add_geometry(g.value("type", "") == "GeometryInstance" ? templates.at(g["template"]) : g);
  }
  return count;
}

TEST(RealCityJson, EveryPolygonIsInTheModelOrInTheReport) {
  REAL_DATA(root, "cityjson");
  std::size_t files = 0, refused = 0, all = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    ++files;
    try {
      std::size_t polygons = 0;
      const city::ObjectSink count = [&](city::CityObject&& o) { polygons += o.polygons.size(); };
      const city::ReadReport report =
          read_cityjson_staged(entry.path(), {}, city::deliver_to(count));
      for (const auto& [what, number] : report.skipped)
        if (what.starts_with("polygon: ")) polygons += number;
      EXPECT_EQ(polygons, polygons_in(entry.path())) << entry.path();
      all += polygons;
    } catch (const Error& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find("CityJSONFeature"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_GT(files, 30u);
  EXPECT_EQ(refused, 1u) << "a feature without the line that says where it lies";
  std::printf("%zu files, %zu refused, %zu polygons\n", files, refused, all);
}

TEST(CityJsonCorpus, EveryDocumentIsReadOrRefused) {
  std::size_t files = 0;
  const auto folder = std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/tools/cityjson/corpus";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++files;
    try {
      const city::ObjectSink check = [&](city::CityObject&& object) {
        for (const city::Polygon& polygon : object.polygons)
          for (const glm::dvec3& p : polygon.exterior) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
      };
      read_cityjson_staged(entry.path(), {}, city::deliver_to(check));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(entry.path().filename().string()), std::string::npos)
          << error.what();
    }
  }
  EXPECT_GE(files, 4u);
}

}  // namespace
}  // namespace nightcity::cityjson
