// Makes a city object of a 1st-level object of CityJSON and the objects below it.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "tools/city/merge_parts.h"
#include "tools/city/skip_counter.h"
#include "tools/cityjson/cityjson_types.h"
#include "tools/cityjson/geometry_reader.h"

namespace nightcity::cityjson {

struct GroupMember {
  std::string_view id;
  ObjectClass what;
  dom::object object;
};

/// Reads a group that group_objects() has made, the 1st-level object first. Returns none where it
/// is of an extension, the inside of a building, or a list; it is counted then.
std::optional<city::RawObject> read_object(std::span<const GroupMember> group,
                                           const GeometrySources& sources,
                                           city::SkipCounter& skipped);

}  // namespace nightcity::cityjson
