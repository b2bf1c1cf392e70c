// Places shapes that several objects share: implicit geometries.
#include <algorithm>
#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

#include "tools/city/placement_matrix.h"
#include "tools/citygml/geometry_names.h"
#include "tools/citygml/geometry_walk.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {

// A shared shape placed by a 4 x 4 matrix (row-major in the file) and a reference point added to
// it.
void GeometryWalk::read_implicit(const pugi::xml_node& element, const GeometryContext& context) {
  glm::dmat4 matrix(1.0);
  glm::dvec3 reference(0.0);
  bool has_place = false;
  SrsName srs_name = context.srs_name;
  std::vector<double> numbers;
  std::vector<pugi::xml_node> shapes;
  for (const pugi::xml_node& child : element.children()) {
    const std::string_view name = local_name(child.name());
    numbers.clear();
    if (name == "transformationMatrix") {
      if (!read_numbers(child, numbers) || numbers.size() != 16) {
        skipped_.add("implicit geometry: matrix that is none");
        return;
      }
      std::array<double, 16> rows;
      std::copy(numbers.begin(), numbers.end(), rows.begin());
      const auto placement = city::make_placement(rows);
      if (!placement) {
        skipped_.add("implicit geometry: matrix that is none");
        return;
      }
      matrix = *placement;
    } else if (name == "referencePoint") {
      std::vector<glm::dvec3> points;
      std::vector<city::Ring> lines;
      Points read{points, lines};
      walk_points(child, context, read);
      has_place = !points.empty();
      if (has_place) reference = points.front();
      srs_name = read.srs_name.value_or(context.srs_name);
    } else if (name == "relativeGMLGeometry" || name == "relativeGeometry") {
      shapes.push_back(child);
    } else if (child.type() == pugi::node_element && name != "mimeType") {
      skipped_.add(child.name());
    }
  }
  matrix[3] += glm::dvec4(reference, 0.0);
  GeometryContext placed = context;
  placed.placed = &matrix;
  placed.anchor = has_place ? &reference : nullptr;
  placed.srs_name = std::move(srs_name);  // the shape's own coordinates have none
  if (plant_ && has_place) add_place(glm::dvec3(matrix[3]), placed.srs_name);
  // The same shape may be placed many times, but only once by each implicit geometry.
  Visits visited, linked;
  visited.swap(visited_);
  linked.swap(linked_);
  for (const pugi::xml_node& shape : shapes) {
    const std::string_view href = find_attribute(shape, "href");
    if (!href.empty() && !shape.first_child()) follow(shape, href, placed);
    walk_children(shape, placed);
  }
  visited_.swap(visited);
  linked_.swap(linked);
}

void GeometryWalk::add_place(const glm::dvec3& place, const SrsName& srs_name) {
  if (plant_->points.empty()) plant_->points_srs_name = srs_name;
  if (plant_->points_srs_name == srs_name) plant_->points.push_back(place);
}

}  // namespace nightcity::citygml
