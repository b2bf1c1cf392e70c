// Lists the content of a glTF file that this program does not show, from the file's JSON alone.
#pragma once

#include <string>
#include <vector>

#include "formats/gltf_document.h"

namespace nightcity {

/// Throws Error, without a file name, if the file requires an extension that is not known: it would
/// change the meaning of the data.
void check_required_extensions(const gltf::Document& document);

/// Returns one sentence for each kind of content that is not shown: skins, morph targets,
/// animations, points and lines, lights of KHR_lights_punctual, unknown extensions. Lights in a
/// baked scene (`baked`) are copies of those in its light file and no loss. Materials are not
/// looked at.
std::vector<std::string> describe_skipped(const gltf::Document& document, bool baked);

}  // namespace nightcity
