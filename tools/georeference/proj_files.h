// The files that PROJ may open for a definition that comes from a stranger's file.
#pragma once

#include <proj.h>

#include <string>

namespace nightcity::georeference {

/// Lets PROJ open nothing but regular files in its own folders (PROJ_DATA, PROJ_LIB, the system's):
/// a definition can name any other as a grid or by +init. What was refused, and is there, is
/// written to `refused`, which must live as long as the context.
void keep_to_own_files(PJ_CONTEXT* context, std::string& refused);

}  // namespace nightcity::georeference
