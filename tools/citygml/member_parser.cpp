#include "tools/citygml/member_parser.h"

#include <algorithm>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/end_date.h"
#include "tools/city/plant_attributes.h"
#include "tools/citygml/heights.h"
#include "tools/citygml/tag_scanner.h"
#include "tools/today.h"

namespace nightcity::citygml {
namespace {

// Takes the first function of a traffic area that is a code: the code says who may go there.
bool read_area_function(const FeatureClass& what, std::string_view name,
                        const pugi::xml_node& property, GeometryContext& context) {
  if (what.surface != city::SurfaceType::traffic_area || name != "function") return false;
  const auto code = city::parse_number(property.child_value());
  if (context.area_function == 0 && code && *code >= 1 && *code <= 65535)
    context.area_function = static_cast<std::uint16_t>(*code);
  return true;
}

// Takes what an attribute with a plain value says of a plant.
bool read_plant(std::string_view name, const pugi::xml_node& property, city::Plant& plant) {
  return find_property_kind(name) != PropertyKind::geometry &&
         city::set_plant_attribute(plant, to_lower(name), property.child_value(),
                                   find_attribute(property, "uom"));
}

// WFS 2.0, section 11.3: the answer to several queries is a collection of collections, that to a
// join one of tuples.
bool is_collection(std::string_view local) {
  return local == "FeatureCollection" || local == "SimpleFeatureCollection" || local == "Tuple";
}

bool is_member(std::string_view local) {
  return local == "member" || local == "featureMember" || local == "featureMembers" ||
         local == "cityObjectMember";
}

// Returns why an object is not there by what a property says; null: it says no such thing.
const char* find_reason_to_leave_out(const FeatureClass& what, std::string_view name,
                                     const pugi::xml_node& property) {
  const std::string lower = what.kind == ClassKind::top ? to_lower(name) : std::string();
  if (!city::may_say_when(what.object, lower)) return nullptr;
  return city::find_reason_to_leave_out(what.object, lower, property.child_value(), today());
}

bool is_own_space(ClassKind kind) {
  return kind == ClassKind::top || kind == ClassKind::part;
}

}  // namespace

MemberParser::MemberParser(const pugi::xml_node& member, std::size_t line,
                           const GeometryLibrary& library, const Materials& file_materials)
    : member_(member), line_(line), library_(library), geometry_(member, library, skipped_) {
  geometry_.set_file_materials(&file_materials);
  geometry_.local_materials().set_pictures(library.pictures);
}

std::vector<city::RawObject> MemberParser::parse() {
  std::vector<city::RawObject> out;
  if (find_feature_class(local_name(member_.name())).kind != ClassKind::unknown) {
    read_top(member_, out);
    return out;
  }
  for (const pugi::xml_node& child : member_.children())
    if (child.type() == pugi::node_element) read_top(child, out);
  if (out.empty()) count_link(find_attribute(member_, "href"));
  return out;
}

// An object that is a member elsewhere in this file, or in another file of the city, is read there.
void MemberParser::count_link(std::string_view href) {
  if (href.empty() || library_.is_in_document(href) || !library_.name_elsewhere(href).empty())
    return;
  skipped_.add("xlink: to an object in another file (" +
               std::string(city::trim(href.substr(0, href.find('#')))) + ")");
}

void MemberParser::skip(const pugi::xml_node& element) {
  skipped_.add(element.name());
  if (!element.first_child().first_child()) return;  // text at most, no geometry
  if (const std::size_t polygons = count_polygons(element); polygons > 0)
    skipped_.add("polygon: in " + std::string(element.name()), polygons);
}

void MemberParser::read_top(const pugi::xml_node& element, std::vector<city::RawObject>& out,
                            int depth) {
  const std::string_view name = local_name(element.name());
  if (is_collection(name) && depth < max_nesting) {
    for (const pugi::xml_node& property : element.children())
      if (is_member(local_name(property.name())))
        for (const pugi::xml_node& child : property.children())
          if (child.type() == pugi::node_element) read_top(child, out, depth + 1);
    return;
  }
  const FeatureClass what = find_feature_class(name);
  if (what.kind == ClassKind::unknown || what.kind == ClassKind::interior) {
    skip(element);
    return;
  }
  // The members of a group are objects of their own; the group itself is a list.
  if (name == "CityObjectGroup") {
    skipped_.add(element.name());
    for (const pugi::xml_node& property : element.children())
      if (local_name(property.name()) != "groupMember") {
        if (count_polygons(property) > 0) skip(property);  // an outline of the group's own
      } else {
        for (const pugi::xml_node& child : property.children())
          if (child.type() == pugi::node_element) {
            if (depth < max_nesting)
              read_top(child, out, depth + 1);
            else
              skip(child);
          }
      }
    return;
  }
  // Writers that lost the building write its surfaces as members.
  if (what.kind == ClassKind::surface && what.object == city::ObjectType::other)
    skipped_.add("building of a " + std::string(element.name()) +
                 " that is a member of its own: no windows");
  city::RawObject& raw = out.emplace_back();
  raw.object.id = find_attribute(element, "id");
  if (raw.object.id.empty()) raw.object.id = std::string(name) + "@" + std::to_string(line_);
  raw.object.class_name = name;
  raw.object.type = what.object;
  GeometryContext context;
  context.srs_name = srs_name_;
  read_feature(element, what, context, raw);
  if (!raw.left_out) return;
  city::count_left_out(raw, skipped_);
  out.pop_back();
}

void MemberParser::read_feature(const pugi::xml_node& element, const FeatureClass& what,
                                GeometryContext context, city::RawObject& raw) {
  context.surface = what.surface != city::SurfaceType::unknown || what.kind != ClassKind::surface
                        ? what.surface
                        : context.surface;
  context.srs_name = geometry_.find_srs_name_in(element, context.srs_name);
  city::CityObject said;
  if (what.object == city::ObjectType::vegetation) said.plant.emplace();
  std::vector<pugi::xml_node> children, geometries, points, subdivisions;
  const std::size_t before = raw.polygons.size();
  Elevations elevations;
  int relief_lod = -1;
  for (const pugi::xml_node& property : element.children()) {
    if (property.type() != pugi::node_element) continue;
    const std::string_view name = local_name(property.name());
    if (said.plant && read_plant(name, property, *said.plant)) continue;
    if (!raw.left_out) raw.left_out = find_reason_to_leave_out(what, name, property);
    switch (find_property_kind(name)) {
      case PropertyKind::attribute:
        if (is_own_space(what.kind))
          city::set_attribute(said, to_lower(name), property.child_value(),
                              find_attribute(property, "uom"));
        else if (!read_area_function(what, name, property, context))
          skipped_.add(property.name());
        break;
      case PropertyKind::features:
        children.push_back(property);
        break;
      case PropertyKind::geometry:
        geometries.push_back(property);
        break;
      case PropertyKind::relief_lod:
        if (const auto lod = city::parse_number(property.child_value()))
          relief_lod = static_cast<int>(std::clamp(*lod, -1.0, 4.0));
        break;
      case PropertyKind::subdivision:
        subdivisions.push_back(property);
        break;
      case PropertyKind::points:
        points.push_back(property);
        break;
      case PropertyKind::address:
        if (said.address.empty()) said.address = read_address(property);
        break;
      case PropertyKind::appearance:
        geometry_.local_materials().read(property, skipped_);
        break;
      case PropertyKind::height:
        read_height(property, said);
        break;
      case PropertyKind::elevation:
        elevations.read(property);
        break;
      case PropertyKind::name:
        break;
      case PropertyKind::skip:
        if (!is_own_space(what.kind) || !read_generic(property, raw.named_heights)) skip(property);
        break;
    }
  }
  city::adopt_attributes(raw.object, said);
  raw.elevation_span = std::max(raw.elevation_span, elevations.span());
  geometry_.set_plant(said.plant ? &raw.object : nullptr);
  // Surfaces first: a solid that refers to their polygons then leaves them their surface type.
  for (const pugi::xml_node& property : children) read_child_features(property, context, raw);
  for (const pugi::xml_node& property : geometries) {
    const int lod = read_lod(local_name(property.name()));
    GeometryContext here = context;
    here.lod = lod >= 0 ? lod : relief_lod;
    if (local_name(property.name()) == "lod0RoofEdge") here.surface = city::SurfaceType::roof;
    if (local_name(property.name()) == "lod0FootPrint") here.surface = city::SurfaceType::ground;
    if (!geometry_.read_tin_points(property, here, raw.object))
      geometry_.read(property, here, raw.polygons);
  }
  for (const pugi::xml_node& property : points)
    geometry_.read_points(property, context, raw.object);
  // Storeys and units cut up what the building shows, unless it shows nothing itself.
  const bool is_hollow = raw.polygons.size() == before;
  for (const pugi::xml_node& property : subdivisions)
    if (is_hollow)
      read_child_features(property, context, raw);
    else
      skip(property);
}

void MemberParser::read_child_features(const pugi::xml_node& property,
                                       const GeometryContext& context, city::RawObject& raw) {
  if (!property.first_child()) {
    if (!find_attribute(property, "href").empty())
      skipped_.add("xlink: " + std::string(property.name()));
    return;
  }
  const std::string_view name = local_name(property.name());
  for (const pugi::xml_node& child : property.children())
    if (child.type() == pugi::node_element) read_child(child, name, context, raw);
}

void MemberParser::read_child(const pugi::xml_node& element, std::string_view property,
                              const GeometryContext& context, city::RawObject& raw) {
  const std::string_view name = local_name(element.name());
  // gml:boundedBy: an extent, which the vertices give better.
  if (name == "Envelope" || name == "Null") return;
  FeatureClass what = find_feature_class(name);
  if (what.kind == ClassKind::unknown && count_polygons(element) > 0)
    what = find_class_at(property);
  GeometryContext inside = context;
  if (++inside.depth > max_nesting) {
    skipped_.add("nested too deep: " + std::string(element.name()));
    if (const std::size_t polygons = count_polygons(element); polygons > 0)
      skipped_.add("polygon: nested too deep", polygons);
    return;
  }
  switch (what.kind) {
    case ClassKind::unknown:
      skip(element);
      return;
    case ClassKind::interior:
      skipped_.add(element.name());
      if (const std::size_t polygons = count_polygons(element); polygons > 0)
        skipped_.add("polygon: inside a building", polygons);
      return;
    case ClassKind::part:
    case ClassKind::detail:
      inside.space = static_cast<std::uint32_t>(raw.spaces.size());
      raw.spaces.push_back({what.kind == ClassKind::detail});
      break;
    case ClassKind::top:
    case ClassKind::surface:
    case ClassKind::passage:
      break;
  }
  read_feature(element, what, inside, raw);
}

std::string read_address(const pugi::xml_node& address) {
  struct Found : pugi::xml_tree_walker {
    city::Address address;
    bool for_each(pugi::xml_node& node) override {
      const std::string_view name = local_name(node.name());
      const auto take = [&](std::string& field) {
        if (field.empty()) field = city::trim(node.child_value());
      };
      if (name == "ThoroughfareName") take(address.street);
      if (name == "ThoroughfareNumber") take(address.number);
      if (name == "PostalCodeNumber") take(address.code);
      if (name == "LocalityName") take(address.place);
      if (name == "CountryName") take(address.country);
      return true;
    }
  } found;
  pugi::xml_node(address).traverse(found);
  return city::to_text(found.address);
}

}  // namespace nightcity::citygml
