#include "tools/city/plant_attributes.h"

#include <string>

#include "tools/city/attributes.h"
#include "tools/city/length_unit.h"

namespace nightcity::city {
namespace {

void set_size(std::optional<double>& field, int& odd_sizes, std::string_view value,
              std::string_view unit, double max_m) {
  if (value.empty()) return;
  const auto number = parse_number(value);
  if (number && is_sentinel(*number)) return;
  const auto metres = find_metres_per(unit);
  if (number && metres && *number * *metres > 0 && *number * *metres <= max_m)
    field = *number * *metres;
  else
    ++odd_sizes;
}

}  // namespace

bool set_plant_attribute(Plant& plant, std::string_view name, std::string_view value,
                         std::string_view unit) {
  value = trim(value);
  if (name == "height" || name == "averageheight")
    set_size(plant.height_m, plant.odd_sizes, value, unit, max_plant_height_m);
  else if (name == "crowndiameter")
    set_size(plant.crown_m, plant.odd_sizes, value, unit, max_crown_m);
  else if (name == "trunkdiameter")
    set_size(plant.trunk_m, plant.odd_sizes, value, unit, max_trunk_m);
  else if (name == "species")
    plant.species = value;
  else
    return false;
  return true;
}

void adopt_plant(std::optional<Plant>& whole, const std::optional<Plant>& part) {
  if (!part) return;
  if (!whole) whole.emplace();
  if (!whole->height_m) whole->height_m = part->height_m;
  if (!whole->crown_m) whole->crown_m = part->crown_m;
  if (!whole->trunk_m) whole->trunk_m = part->trunk_m;
  if (whole->species.empty()) whole->species = part->species;
  whole->odd_sizes += part->odd_sizes;
}

}  // namespace nightcity::city
