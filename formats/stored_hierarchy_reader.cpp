#include "formats/stored_hierarchy_reader.h"

#include <cmath>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_numbers.h"

namespace nightcity {
namespace {

using gltf::Json;
using gltf::member;

std::uint32_t read_count(const Json& source, const char* key) {
  const auto value = gltf::index(source, key);
  if (!value || *value >= no_id) throw Error("", key, "is no number below 2^32 - 1");
  return static_cast<std::uint32_t>(*value);
}

glm::vec3 read_corner(const Json& source, const char* key) {
  const auto values = gltf::numbers(source, key, std::vector<double>(3, NAN));
  const glm::vec3 corner(static_cast<float>(values[0]), static_cast<float>(values[1]),
                         static_cast<float>(values[2]));
  if (!finite(corner)) throw Error("", key, "is not 3 finite numbers");
  return corner;
}

glm::vec2 read_direction(const Json& source) {
  const auto values = gltf::numbers(source, "along", {1, 0});
  const glm::vec2 along(static_cast<float>(values[0]), static_cast<float>(values[1]));
  if (!is_direction(along)) throw Error("", "along", "is no unit vector");
  return along;
}

std::vector<std::uint32_t> read_nodes(const Json& source) {
  const Json& nodes = member(source, "nodes");
  if (!nodes.is_array()) throw Error("", "nodes", "is no array");
  std::vector<std::uint32_t> result;
  result.reserve(nodes.size());
  for (const Json& node : nodes) {
    if (!node.is_number_unsigned() || node.get<std::uint64_t>() >= no_id)
      throw Error("", "nodes", "holds something that is no node index");
    result.push_back(node.get<std::uint32_t>());
  }
  return result;
}

StoredHierarchy read_hierarchy(const Json& source, const gltf::AccessorReader& accessors) {
  StoredHierarchy result;
  result.casts_shadow = gltf::boolean(source, "castsShadow", true);
  result.nodes = read_nodes(source);
  result.triangles = read_count(source, "triangles");
  result.lower = read_corner(source, "min");
  result.upper = read_corner(source, "max");
  result.along = read_direction(source);
  result.area_m2 = gltf::number(source, "area", NAN);
  if (!std::isfinite(result.area_m2)) throw Error("", "area", "is no finite number");
  // A hierarchy of one leaf has no node.
  if (const auto view = gltf::index(source, "topology")) result.topology = accessors.view(*view);
  result.order = accessors.view(read_count(source, "order"));
  if (const auto view = gltf::index(source, "cuts")) result.cuts = accessors.view(*view);
  return result;
}

}  // namespace

std::vector<StoredHierarchy> read_hierarchies(const gltf::Document& document,
                                              const gltf::AccessorReader& accessors,
                                              std::vector<std::string>& sentences) {
  std::vector<StoredHierarchy> result;
  const Json& ours = gltf::extension(document.root(), gltf::hierarchy);
  if (ours.is_null()) return result;
  try {
    const Json& all = member(ours, "hierarchies");
    if (!all.is_array()) throw Error("", "hierarchies", "is no array");
    for (const Json& source : all) {
      result.push_back(read_hierarchy(source, accessors));
      for (std::size_t i = 0; i + 1 < result.size(); ++i)
        if (result[i].casts_shadow == result.back().casts_shadow)
          throw Error("", "castsShadow", "is the same in two of them");
    }
  } catch (const Error& error) {
    sentences.push_back(std::string(gltf::hierarchy) + " is not used: " + error.what());
    result.clear();
  }
  return result;
}

}  // namespace nightcity
