// Reads geometry that is no surface: points, break lines, and what defines a Tin without triangles.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/city/ring.h"
#include "tools/citygml/geometry_names.h"
#include "tools/citygml/geometry_walk.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {

namespace {

// Reads GML 2's <coordinates> or <coord> as numbers of three coordinates a point.
bool read_old_point(const pugi::xml_node& element, std::vector<double>& numbers) {
  city::Ring vertices;
  pugi::xml_document alone;
  alone.append_child("p").append_copy(element);
  if (read_vertices(alone.document_element(), 0, vertices) != RingFault::none) return false;
  for (const glm::dvec3& p : vertices) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return true;
}

}  // namespace

bool GeometryWalk::read_tin_points(const pugi::xml_node& property, const GeometryContext& context,
                                   city::CityObject& object) {
  const auto is_tin = [](const pugi::xml_node& node) { return local_name(node.name()) == "Tin"; };
  const pugi::xml_node tin = property.find_child(is_tin);
  if (!tin || count_polygons(tin) > 0) return false;
  GeometryContext inside = context;
  inside.dimension = find_dimension(tin, context.dimension);
  take_own_srs_name(tin, inside);
  bool any = false;
  for (const pugi::xml_node& child : tin.children()) {
    const std::string_view name = local_name(child.name());
    if (name != "controlPoint" && name != "breakLines" && name != "stopLines") continue;
    read_points(child, inside, object);
    any = true;
  }
  return any;
}

void GeometryWalk::read_points(const pugi::xml_node& property, const GeometryContext& context,
                               city::CityObject& object) {
  Points out{object.points, object.lines};
  if (!object.points.empty() || !object.lines.empty()) out.srs_name = object.points_srs_name;
  walk_points(property, context, out);
  object.points_srs_name = out.srs_name.value_or(nullptr);
}

void GeometryWalk::walk_points(const pugi::xml_node& property, const GeometryContext& context,
                               Points& out) {
  GeometryContext inside = context;
  inside.dimension = find_dimension(property, context.dimension);
  take_own_srs_name(property, inside);
  if (++inside.depth > max_nesting) {
    skipped_.add("nested too deep: " + std::string(property.name()));
    return;
  }
  const std::string_view name = local_name(property.name());
  const bool is_of_gml2 = name == "coordinates" || name == "coord";
  if (name != "pos" && name != "posList" && !is_of_gml2) {
    const bool is_line =
        name == "LineString" || name == "LineStringSegment" || name == "LinearRing";
    city::Ring line;
    Points below{is_line ? line : out.points, out.lines, out.srs_name};
    for (const pugi::xml_node& child : property.children())
      if (child.type() == pugi::node_element) walk_points(child, inside, below);
    out.srs_name = below.srs_name;
    if (line.size() > 1)
      out.lines.push_back(std::move(line));
    else
      out.points.insert(out.points.end(), line.begin(), line.end());
    return;
  }
  std::vector<double> numbers;
  const std::size_t d = inside.dimension == 2 && !is_of_gml2 ? 2 : 3;
  const bool is_sound =
      is_of_gml2 ? read_old_point(property, numbers) : read_numbers(property, numbers);
  if (!is_sound || numbers.size() % d != 0) {
    skipped_.add("points: coordinates that are no numbers");
    return;
  }
  if (!out.srs_name) out.srs_name = inside.srs_name;
  if (*out.srs_name != inside.srs_name) {
    skipped_.add("point: of another CRS than the object's first", numbers.size() / d);
    return;
  }
  for (std::size_t i = 0; i < numbers.size(); i += d) {
    const glm::dvec3 p(numbers[i], numbers[i + 1], d == 3 ? numbers[i + 2] : 0.0);
    if (city::is_sentinel_height(p.z))
      skipped_.add("point: at a height that stands for none (-9999 and the like)");
    else
      out.points.push_back(p);
  }
}

}  // namespace nightcity::citygml
