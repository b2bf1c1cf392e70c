#include "formats/georeference_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "formats/json_parse.h"

namespace nightcity {

nlohmann::json georeference_to_json(const Georeference& georeference) {
  const glm::dvec3& o = georeference.origin;
  nlohmann::json json = {
      {"crs", georeference.crs},
      {"origin", {o.x, o.y, o.z}},
      {"frame", "x = east, y = up, z = south; metres from origin (easting, northing, height)"},
      {"sources", georeference.sources},
      {"licences", georeference.licences}};
  if (!georeference.scene_id.empty()) json["scene_id"] = georeference.scene_id;
  return json;
}

Georeference georeference_from_json(const nlohmann::json& json) {
  Georeference result;
  try {
    result.crs = json.value("crs", std::string());
    result.sources = json.value("sources", std::vector<std::string>());
    result.licences = json.value("licences", std::vector<std::string>());
    result.scene_id = json.value("scene_id", std::string());
    const auto origin = json.value("origin", std::vector<double>{0, 0, 0});
    if (origin.size() != 3) throw Error("", "georeference", "origin is not three numbers");
    result.origin = {origin[0], origin[1], origin[2]};
  } catch (const nlohmann::json::exception& error) {
    throw Error("", "georeference", describe(error));
  }
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(result.origin[i])) throw Error("", "georeference", "origin is not finite");
  return result;
}

}  // namespace nightcity
