// Reads one polygon: its rings, what is wrong with them, and its picture.
#include <string>
#include <utility>

#include "tools/city/attributes.h"
#include "tools/city/ring.h"
#include "tools/citygml/geometry_names.h"
#include "tools/citygml/geometry_walk.h"
#include "tools/citygml/picture_colours.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {

void GeometryWalk::read_polygon(const pugi::xml_node& element, const GeometryContext& context) {
  if (!visited_.insert(visit_of(element, context)).second) return;
  const int dimension = find_dimension(element, context.dimension);
  city::Polygon polygon;
  polygon.id = find_attribute(element, "id");
  polygon.surface = context.surface;
  polygon.area_function = context.area_function;
  const glm::vec3* colour = find_colour(element);
  if (!colour) colour = context.colour;
  if (colour) polygon.diffuse_colour = *colour;
  GeometryContext own = context;
  take_own_srs_name(element, own);
  polygon.srs_name = std::move(own.srs_name);
  RingFault fault = RingFault::no_coordinates;
  bool has_exterior = false;
  PolygonTexture texture;
  for (const pugi::xml_node& boundary : element.children()) {
    const std::string_view side = local_name(boundary.name());
    const bool outer = side == "exterior" || side == "outerBoundaryIs";
    if (!outer && side != "interior" && side != "innerBoundaryIs") {
      if (boundary.type() == pugi::node_element) skipped_.add(boundary.name());
      continue;
    }
    // The schema allows one exterior, and one ring in each boundary. Further holes are meant as
    // such.
    pugi::xml_node ring_element = boundary.first_child();
    do {
      city::Ring ring;
      if (outer && has_exterior) {
        skipped_.add("ring: a further exterior of its polygon");
      } else if (const RingFault ring_fault = read_ring(ring_element, dimension, ring); outer) {
        has_exterior = true;
        fault = ring_fault;
        if (ring_fault == RingFault::none)
          texture.add(find_ring_texture(ring_element), ring.size());
        polygon.exterior = std::move(ring);
      } else if (ring_fault != RingFault::none) {
        skipped_.add("hole: " + std::string(name_of(ring_fault)));
      } else {
        texture.add(find_ring_texture(ring_element), ring.size());
        polygon.interiors.push_back(std::move(ring));
      }
      ring_element = ring_element.next_sibling();
    } while (ring_element);
  }
  if (fault != RingFault::none) {
    skipped_.add("polygon: " + std::string(name_of(fault)));
    return;
  }
  if (!context.placed && city::has_sentinel_height(polygon)) {
    skipped_.add("polygon: at a height that stands for none (-9999 and the like)");
    return;
  }
  if (texture.is_whole())
    polygon.picture = texture.cut(*library_.pictures, skipped_, pixels_left_);
  else if (texture.is_misfit())
    skipped_.add(city::texture_misfit);
  if (context.reversed) city::reverse_rings(polygon);
  add(std::move(polygon), context);
}

}  // namespace nightcity::citygml
