// The kind of a city object, from its name or those of its materials: an OBJ says it nowhere else.
#pragma once

#include <optional>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity::obj {

/// Returns building, relief, road, water or vegetation where a word of the name says so ("House 3",
/// "Terrain_01", "roads.003", "tree"); empty elsewhere.
std::optional<city::ObjectType> find_named_type(std::string_view name);
/// The same, and building elsewhere.
city::ObjectType find_object_type(std::string_view name);

/// Returns the kind that a material's whole name is ("Terrain", "water"), else building: a pool or
/// a paved court makes no lake or street of a house.
city::ObjectType find_material_type(std::string_view name);

}  // namespace nightcity::obj
