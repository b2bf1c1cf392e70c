#include "tools/cityjson/object_reader.h"

#include <string>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/end_date.h"
#include "tools/city/plant_attributes.h"
#include "tools/today.h"

namespace nightcity::cityjson {
namespace {

// Returns a value as text; an array's values with blanks between, as CityGML writes lists.
std::string to_list_text(const dom::element& value) {
  dom::array array;
  if (value.get(array) != simdjson::SUCCESS) return to_text(value);
  std::string text;
  for (const dom::element& one : array) {
    const std::string word = to_text(one);
    if (!word.empty()) text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

// A length: a number of metres or, as converters from CityGML write it, {"value": 12, "uom": "ft"}.
struct Measure {
  std::string value, unit;
};

Measure to_measure(const dom::element& value) {
  dom::object object;
  if (value.get(object) != simdjson::SUCCESS) return {to_list_text(value), {}};
  const auto number = find_member(object, "value");
  return {number ? to_text(*number) : std::string(), std::string(find_text(object, "uom"))};
}

// CityJSON keeps the names of CityGML's attributes.
bool read_plant(std::string_view name, const dom::element& value, city::Plant& plant) {
  const Measure measure = to_measure(value);
  return city::set_plant_attribute(plant, to_lower(name), measure.value, measure.unit);
}

// Returns why the object is not there by what they say; null: it is.
const char* read_attributes(const dom::object& object, city::ObjectType type,
                            city::CityObject& said, city::NamedHeights& heights,
                            city::SkipCounter& skipped) {
  const auto attributes = find_object(object, "attributes");
  if (!attributes) return nullptr;
  const char* left_out = nullptr;
  std::size_t others = 0;
  for (const auto& [name, value] : *attributes) {
    const std::string_view field = find_attribute_field(name);
    dom::array values;
    if (said.plant && read_plant(name, value, *said.plant)) continue;
    const bool repeats = field == "function" || field == "usage" || field == "class";
    const std::string lower = to_lower(name);
    const bool says_when = city::may_say_when(type, lower);
    if (says_when && !left_out)
      left_out = city::find_reason_to_leave_out(type, lower, to_list_text(value), today());
    if (city::NamedHeights::knows(lower) && field.empty()) {
      const Measure measure = to_measure(value);
      heights.take(lower, measure.value, measure.unit);
    } else if (field.empty()) {
      others += !says_when && !value.is_null();
    } else if (repeats && value.get(values) == simdjson::SUCCESS) {
      for (const dom::element& one : values) city::set_attribute(said, field, to_text(one));
    } else {
      const Measure measure = to_measure(value);
      city::set_attribute(said, field, measure.value, measure.unit);
    }
  }
  if (others > 0) skipped.add("attribute", others);
  return left_out;
}

// Addresses have free keys since CityJSON 1.1; these are those of the specification's examples.
std::string read_address(const dom::element& value) {
  dom::object address;
  if (dom::array several; value.get(several) == simdjson::SUCCESS) {
    if (several.size() == 0) return {};
    return read_address(*several.begin());
  }
  if (value.get(address) != simdjson::SUCCESS) return {};
  const auto first_of = [&](std::initializer_list<std::string_view> keys) -> std::string {
    for (const std::string_view key : keys)
      if (const auto found = find_member(address, key)) return to_text(*found);
    return {};
  };
  return city::to_text(
      city::Address{first_of({"ThoroughfareName", "thoroughfareName", "street"}),
                    first_of({"ThoroughfareNumber", "thoroughfareNumber", "number"}),
                    first_of({"PostalCode", "Postcode", "PostalCodeNumber", "postalCode"}),
                    first_of({"LocalityName", "Locality", "localityName", "city"}),
                    first_of({"CountryName", "Country", "countryName", "country"})});
}

void count_skipped(const GroupMember& member, const char* why, city::SkipCounter& skipped) {
  const std::string_view type = find_text(member.object, "type");
  skipped.add(type.empty() ? "object without a type" : type);
  const auto geometries = find_array(member.object, "geometry");
  const std::size_t polygons = geometries ? count_polygons(*geometries) : 0;
  if (polygons > 0) skipped.add(why, polygons);
}

void read_member(const GroupMember& member, std::uint32_t space, GeometryReader& geometry,
                 city::RawObject& raw, city::SkipCounter& skipped) {
  if (member.what.role == ObjectRole::top || member.what.role == ObjectRole::part) {
    city::CityObject said;
    if (member.what.type == city::ObjectType::vegetation) said.plant.emplace();
    const char* left_out =
        read_attributes(member.object, member.what.type, said, raw.named_heights, skipped);
    if (space == 0) raw.left_out = left_out;
    if (const auto address = find_member(member.object, "address"))
      said.address = read_address(*address);
    city::adopt_attributes(raw.object, said);
  }
  geometry.set_places(raw.object.plant ? &raw.object.points : nullptr);
  if (const auto geometries = find_array(member.object, "geometry"))
    geometry.read(*geometries, space, member.what.surface, raw.polygons);
  else if (find_member(member.object, "geometry"))
    skipped.add("geometry that is no array");
}

}  // namespace

std::optional<city::RawObject> read_object(std::span<const GroupMember> group,
                                           const GeometrySources& sources,
                                           city::SkipCounter& skipped) {
  const GroupMember& root = group.front();
  switch (root.what.role) {
    case ObjectRole::top:
    case ObjectRole::part:
    case ObjectRole::detail:
      break;
    case ObjectRole::interior:
      count_skipped(root, "polygon: inside a building", skipped);
      return {};
    case ObjectRole::group:
    case ObjectRole::unknown:
      count_skipped(root, "polygon: of an extension's object", skipped);
      return {};
  }
  std::optional<city::RawObject> made(std::in_place);  // as it is returned: it is large to move
  city::RawObject& raw = *made;
  raw.object.id = root.id;
  raw.object.class_name = find_text(root.object, "type");
  raw.object.type = root.what.type;
  GeometryReader geometry(sources, skipped);
  read_member(root, 0, geometry, raw, skipped);
  const auto read_space = [&](const GroupMember& member) {
    const auto space = static_cast<std::uint32_t>(raw.spaces.size());
    raw.spaces.push_back({member.what.role == ObjectRole::detail});
    read_member(member, space, geometry, raw, skipped);
  };
  for (const GroupMember& member : group.subspan(1))
    if (member.what.role != ObjectRole::interior) read_space(member);
  // Storeys and units cut up what the building shows, unless it shows nothing itself.
  const bool is_hollow = raw.polygons.empty();
  for (const GroupMember& member : group.subspan(1)) {
    if (member.what.role != ObjectRole::interior) continue;
    const std::string_view type = find_text(member.object, "type");
    if (is_hollow && (type == "BuildingStorey" || type == "BuildingUnit"))
      read_space(member);
    else
      count_skipped(member, "polygon: inside a building", skipped);
  }
  return made;
}

}  // namespace nightcity::cityjson
