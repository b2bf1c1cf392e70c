// The names of CityJSON 1.0 to 2.0 and what each stands for in our model.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity::cityjson {

/// The role that a city object plays.
enum class ObjectRole : std::uint8_t {
  top,       // a city object of its own (a 1st-level object), whatever parents it names
  part,      // BuildingPart, BridgePart, ...: a space of its own
  detail,    // installations and constructive elements: they add to their parent
  interior,  // rooms, furniture, storeys: neither lights nor cameras get in
  group,     // a list of objects
  unknown,   // of an extension ("+Noise")
};

struct ObjectClass {
  ObjectRole role = ObjectRole::unknown;
  city::ObjectType type = city::ObjectType::other;
  city::SurfaceType surface = city::SurfaceType::unknown;  // of polygons without semantics
};

/// Returns the class of a city object by its "type".
ObjectClass find_object_class(std::string_view type);

struct SurfaceClass {
  city::SurfaceType surface = city::SurfaceType::unknown;
  bool interior = false;  // of a room
};

/// Returns the class of a semantic surface by its "type"; none for a type of an extension.
std::optional<SurfaceClass> find_surface_class(std::string_view type);

/// Returns the name, in lower case as city::set_attribute takes it, of the field that an attribute
/// stands for; "" for other attributes.
std::string_view find_attribute_field(std::string_view name);

}  // namespace nightcity::cityjson
