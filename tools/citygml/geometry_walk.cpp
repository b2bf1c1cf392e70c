// The way through the elements of a geometry, and along the links in them, to its polygons.
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

}  // namespace nightcity::citygml
