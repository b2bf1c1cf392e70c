// The kind of a city object, from its name: an OBJ says it nowhere else.
#pragma once

#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity::obj {

/// Returns relief, road, water or vegetation where a word of the name says so ("Terrain_01",
/// "roads.003", "tree"), else building.
city::ObjectType find_object_type(std::string_view name);

}  // namespace nightcity::obj
