// Ready objects as bytes: what a part of a bake keeps of the objects that it has read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/bake/city/ready_object.h"

namespace nightcity::bake {

/// Packs objects that follow each other in their file. Their meshes, windows and attributes are
/// kept; outlines only where a consumer may ask for them: of roads, and of objects that may
/// continue the one before (object_feed.h).
std::string pack_objects(const std::vector<ReadyObject>& objects);

/// Returns the objects. `file` is the part's, for messages. Throws Error where the bytes are
/// damaged.
std::vector<ReadyObject> unpack_objects(std::string_view bytes, const std::string& file);

}  // namespace nightcity::bake
