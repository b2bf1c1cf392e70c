// Reads the attributes of plants.
#pragma once

#include <optional>
#include <string_view>

#include "tools/city/city_model.h"

namespace nightcity::city {

/// Larger plants are none, m. The highest known tree has 116 m, and the thickest trunk 14 m; how
/// wide a single crown may be is an assumption.
constexpr double max_plant_height_m = 130, max_crown_m = 100, max_trunk_m = 15;

/// Sets the field that an attribute of vegetation stands for. `name`: local name in lower case
/// ("crowndiameter"). Returns false when the name stands for no field. Sentinels (9999 and the
/// like) leave the field absent, and so do sizes that no plant has, which are counted.
bool set_plant_attribute(Plant& plant, std::string_view name, std::string_view value,
                         std::string_view unit = {});

/// Takes over what a part says and its whole does not.
void adopt_plant(std::optional<Plant>& whole, const std::optional<Plant>& part);

}  // namespace nightcity::city
