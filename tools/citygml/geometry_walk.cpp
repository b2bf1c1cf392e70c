#include "tools/citygml/geometry_walk.h"

#include <algorithm>
#include <array>
#include <glm/vec4.hpp>

#include "formats/percent_text.h"
#include "tools/city/attributes.h"
#include "tools/city/ring.h"
#include "tools/citygml/geometry_names.h"
#include "tools/citygml/picture_colours.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {
namespace {

// The longest chain of xlinks followed: solid to composite to orientable to polygon takes three.
constexpr int max_links = 8;
// Polygons that one member may make by implicit geometry: a few shapes placed often must not fill
// the memory.
constexpr std::size_t max_placed_polygons = 1'000'000;

}  // namespace

std::size_t count_polygons(const pugi::xml_node& element) {
  struct Counter : pugi::xml_tree_walker {
    std::size_t count = 0;
    bool for_each(pugi::xml_node& node) override {
      count += is_polygon(local_name(node.name()));
      return true;
    }
  } counter;
  counter.count = is_polygon(local_name(element.name()));
  pugi::xml_node(element).traverse(counter);
  return counter.count;
}

GeometryWalk::Visit GeometryWalk::visit_of(const pugi::xml_node& element,
                                           const GeometryContext& context) {
  return {reinterpret_cast<std::uintptr_t>(element.internal_object()), context.lod};
}

SrsName GeometryWalk::find_srs_name_in(const pugi::xml_node& feature,
                                       const SrsName& inherited) const {
  return srs_scope_ ? srs_scope_->to_name(extent_srs_name(feature), inherited) : inherited;
}

// Geometry that a link leads to keeps its own name.
void GeometryWalk::take_srs_name_of(const pugi::xml_node& element, GeometryContext& context) const {
  if (!srs_scope_ || context.placed) return;
  context.srs_name = srs_scope_->to_name(find_srs_name(element), srs_scope_->name_of_rest());
}

void GeometryWalk::take_own_srs_name(const pugi::xml_node& element,
                                     GeometryContext& context) const {
  if (srs_scope_ && !context.placed)
    context.srs_name = srs_scope_->to_name(own_srs_name(element), context.srs_name);
}

const glm::vec3* GeometryWalk::find_colour(const pugi::xml_node& element) const {
  if (local_materials_.empty() && (!file_materials_ || file_materials_->empty())) return nullptr;
  const std::string_view id = find_attribute(element, "id");
  if (id.empty()) return nullptr;
  if (const glm::vec3* colour = local_materials_.find(id)) return colour;
  return file_materials_ ? file_materials_->find(id) : nullptr;
}

const RingTexture* GeometryWalk::find_ring_texture(const pugi::xml_node& ring) const {
  if (!library_.pictures || !library_.pictures->keeps_pictures()) return nullptr;
  const std::string_view id = find_attribute(ring, "id");
  if (id.empty()) return nullptr;
  if (const RingTexture* texture = local_materials_.find_ring(id)) return texture;
  return file_materials_ ? file_materials_->find_ring(id) : nullptr;
}

void GeometryWalk::read(const pugi::xml_node& property, const GeometryContext& context,
                        city::RawPolygons& out) {
  out_ = &out;
  const std::string_view href = find_attribute(property, "href");
  if (!href.empty() && !property.first_child()) follow(property, href, context);
  walk_children(property, context);
}

void GeometryWalk::read_element(const pugi::xml_node& geometry, const GeometryContext& context,
                                city::RawPolygons& out) {
  out_ = &out;
  walk(geometry, context);
}

void GeometryWalk::walk_children(const pugi::xml_node& element, const GeometryContext& context) {
  for (const pugi::xml_node& child : element.children())
    if (child.type() == pugi::node_element) walk(child, context);
}

void GeometryWalk::walk(const pugi::xml_node& element, const GeometryContext& context) {
  const std::string_view name = local_name(element.name());
  if (is_polygon(name)) {
    read_polygon(element, context);
    return;
  }
  GeometryContext inside = context;
  if (++inside.depth > max_nesting) {
    skipped_.add("nested too deep: " + std::string(element.name()));
    if (const std::size_t polygons = count_polygons(element); polygons > 0)
      skipped_.add("polygon: nested too deep", polygons);
    return;
  }
  inside.dimension = find_dimension(element, context.dimension);
  take_own_srs_name(element, inside);
  if (const glm::vec3* colour = find_colour(element)) inside.colour = colour;
  if (name == "OrientableSurface") {
    if (find_attribute(element, "orientation") == "-") inside.reversed = !inside.reversed;
    walk_children(element, inside);
  } else if (is_container(name)) {
    const std::string_view href = find_attribute(element, "href");
    if (!href.empty() && !element.first_child()) follow(element, href, inside);
    walk_children(element, inside);
  } else if (name == "ImplicitGeometry") {
    read_implicit(element, inside);
  } else if (plant_ && !context.placed && (name == "Point" || name == "MultiPoint")) {
    read_points(element, context, *plant_);
  } else {
    skipped_.add(element.name());
    if (const std::size_t polygons = count_polygons(element); polygons > 0)
      skipped_.add("polygon: in " + std::string(element.name()), polygons);
  }
}

void GeometryWalk::follow(const pugi::xml_node& link, std::string_view href,
                          const GeometryContext& context) {
  href = city::trim(href);  // as xs:anyURI, which collapses blanks
  const bool here = library_.is_in_document(href);
  std::string id = here ? std::string(city::trim(href.substr(href.find('#') + 1)))
                        : library_.name_elsewhere(href);
  // A link is an address, in which letters beyond ASCII may be encoded; ids are not.
  if (here && id.find('%') != std::string::npos && !ids_.find(id)) id = decode_percent(id);
  if (id.empty()) {
    skipped_.add("xlink: to another file (" + std::string(href.substr(0, href.find('#'))) + ")");
    return;
  }
  GeometryContext there = context;
  if (++there.links > max_links) {
    skipped_.add("xlink: a chain too long, or a cycle");
    return;
  }
  if (const pugi::xml_node target = here ? ids_.find(id) : pugi::xml_node()) {
    const std::string_view kind = local_name(target.name());
    take_srs_name_of(target, there);
    if (!is_geometry(kind)) skipped_.add("xlink: to what is no geometry");
    // The polygons of a target passed before are taken: this ends cycles, and trees of links to
    // links.
    else if (is_polygon(kind) || visited_.insert(visit_of(target, context)).second)
      walk(target, there);
    return;
  }
  const auto shared = library_.polygons.find(id);
  if (shared == library_.polygons.end()) {
    unresolved_.push_back(id);
    skipped_.add("xlink: target not in the file (" + std::string(link.name()) + ")");
    return;
  }
  add_linked(shared->second, there);
}

// A polygon that several links lead to is added once, as one of the member's own is: links to links
// would multiply it.
void GeometryWalk::add_linked(const std::vector<LinkedPolygon>& linked,
                              const GeometryContext& context) {
  for (const LinkedPolygon& one : linked) {
    if (!linked_.insert({static_cast<std::uintptr_t>(one.number), context.lod}).second) continue;
    linked_vertices_ += city::count_vertices(one.polygon);
    if (took_too_many()) {
      skipped_.add("polygon: linked, beyond [city] max_linked_vertices");
      continue;
    }
    city::Polygon copy = one.polygon;
    if (context.reversed) city::reverse_rings(copy);
    if (copy.surface == city::SurfaceType::unknown) copy.surface = context.surface;
    if (copy.area_function == 0) copy.area_function = context.area_function;
    linked_numbers_.resize(out_->size());
    linked_numbers_.push_back(one.number);
    add(std::move(copy), context);
  }
}

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

void GeometryWalk::add(city::Polygon&& polygon, const GeometryContext& context) {
  if (context.placed) {
    polygon.srs_name = context.srs_name;
    if (context.anchor) polygon.anchor = *context.anchor;
    if (++placed_polygons_ > max_placed_polygons) {
      skipped_.add("implicit geometry: more polygons than a member may have");
      return;
    }
    const auto place = [&](city::Ring& ring) {
      for (glm::dvec3& p : ring) p = glm::dvec3(*context.placed * glm::dvec4(p, 1.0));
    };
    place(polygon.exterior);
    for (city::Ring& ring : polygon.interiors) place(ring);
  }
  out_->add(std::move(polygon), {context.lod, context.space});
}

void GeometryWalk::add_place(const glm::dvec3& place, const SrsName& srs_name) {
  if (plant_->points.empty()) plant_->points_srs_name = srs_name;
  if (plant_->points_srs_name == srs_name) plant_->points.push_back(place);
}

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
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
          matrix[column][row] = numbers[static_cast<std::size_t>(4 * row + column)];
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
  // Homogeneous coordinates: a last entry of 2 halves what the matrix makes.
  if (matrix[3][3] == 0) matrix[3][3] = 1;
  if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || !(matrix[3][3] > 0)) {
    skipped_.add("implicit geometry: matrix that is none");
    return;
  }
  matrix /= matrix[3][3];
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
  if (name != "pos" && name != "posList") {
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
  const std::size_t d = inside.dimension == 2 ? 2 : 3;
  if (!read_numbers(property, numbers) || numbers.size() % d != 0) {
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
