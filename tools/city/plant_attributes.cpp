#include "tools/city/plant_attributes.h"

#include <string>
#include <unordered_map>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"

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

std::optional<double> find_metres_per(std::string_view unit) {
  // 9001 to 9003: codes of EPSG. [ft_i]: UCUM.
  static const std::unordered_map<std::string_view, double> table{
      {"", 1},
      {"m", 1},
      {"metre", 1},
      {"metres", 1},
      {"meter", 1},
      {"meters", 1},
      {"9001", 1},
      {"dm", 0.1},
      {"cm", 0.01},
      {"mm", 0.001},
      {"ft", 0.3048},
      {"foot", 0.3048},
      {"feet", 0.3048},
      {"[ft_i]", 0.3048},
      {"9002", 0.3048},
      {"in", 0.0254},
      {"inch", 0.0254},
      {"[in_i]", 0.0254},
      {"us-ft", 1200.0 / 3937},
      {"[ft_us]", 1200.0 / 3937},
      {"9003", 1200.0 / 3937},
  };
  unit = trim(unit);
  if (const auto before = unit.find_last_of(":#/"); before != std::string_view::npos)
    unit.remove_prefix(before + 1);
  const auto at = table.find(to_lower(unit));
  return at == table.end() ? std::nullopt : std::optional(at->second);
}

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
