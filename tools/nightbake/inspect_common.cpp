#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {

Inspection make_empty_inspection(const std::string& kind) {
  Inspection result;
  result["kind"] = kind;
  for (const char* key : {"buildings", "polygons", "triangles"}) result[key] = nullptr;
  result["lights"] = Inspection::object();
  result["crs"] = nullptr;
  result["bbox"] = nullptr;
  result["skipped"] = Inspection::object();
  return result;
}

Inspection Bounds::to_json(int dimensions) const {
  if (!(min.x <= max.x)) return nullptr;
  Inspection result = Inspection::array();
  for (const glm::dvec3& corner : {min, max})
    for (int i = 0; i < dimensions; ++i) result.push_back(corner[i]);
  return result;
}

}  // namespace nightcity::nightbake
