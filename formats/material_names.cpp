#include "formats/material_names.h"

#include <algorithm>
#include <array>

namespace nightcity {

bool is_carriageway_material(std::string_view name) {
  using namespace std::string_view_literals;
  constexpr std::array names{"road"sv, "road marking"sv, "asphalt"sv, "concrete"sv, "sett"sv};
  return std::any_of(names.begin(), names.end(), [&](std::string_view known) {
    if (!name.starts_with(known)) return false;
    const std::string_view rest = name.substr(known.size());
    return rest.empty() || rest.starts_with(" #") || rest.starts_with(" picture ");
  });
}

}  // namespace nightcity
