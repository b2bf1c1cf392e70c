// What the beginning of a CityGML file says: whether it is one, version, CRS, some coordinates.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "tools/city/city_reader.h"
#include "tools/citygml/member_splitter.h"

namespace nightcity {

/// Returns whether the root element is one that holds city objects. `start`: the document's first
/// bytes, as many as hold its root's start tag.
bool begins_as_citygml(std::string_view start);

/// Throws Error when the root element is none that holds city objects.
void require_citygml(const DocumentHead& head, const std::string& name);

/// Returns the first srsName in the batch's members, as written; "" = none.
std::string first_srs_name(const MemberBatch& batch);

/// Reads until it has a sample or the file ends. In the sample rings are closed again, so that one
/// can see where they end. Throws Error as read_citygml does.
CityHead read_citygml_head(const std::filesystem::path& file);

}  // namespace nightcity
