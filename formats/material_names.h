// Names of materials that a reader can tell something from (formats/SPEC.md, section 2.2).
#pragma once

#include <string_view>

namespace nightcity {

/// Returns whether carriageways are made of the material of this name: `road` and `road marking` of
/// a city model and of paint, `asphalt`, `concrete` and `sett` of a map's streets, whatever colour
/// or picture follows. Car parks and yards may be made of the last three, too.
bool is_carriageway_material(std::string_view name);

/// The names of what windows show: a pane through which a room is seen, and an even light. They are
/// those of nightbake's two ways to show windows.
inline constexpr const char* window_pane_material = "lit window";
inline constexpr const char* even_window_material = "even lit window";

}  // namespace nightcity
