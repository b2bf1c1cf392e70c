#include "tools/city/named_heights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "tools/city/attributes.h"

namespace nightcity::city {
namespace {

enum class Meaning : std::uint8_t { height, ground, roof, high_roof, low_roof, storeys };

// Names in lower case. 3DBAG makes its own blocks as high as 70 % of the roof is.
const std::unordered_map<std::string_view, Meaning>& meanings() {
  static const std::unordered_map<std::string_view, Meaning> table{
      {"height", Meaning::height},
      {"measuredheight", Meaning::height},
      {"measured_height", Meaning::height},
      {"buildingheight", Meaning::height},
      {"building_height", Meaning::height},
      {"bldg_height", Meaning::height},
      {"gebaeudehoehe", Meaning::height},
      {"geb\xC3\xA4udeh\xC3\xB6he", Meaning::height},
      {"gesamthoehe", Meaning::height},
      {"hauteur", Meaning::height},
      {"b3_h_maaiveld", Meaning::ground},
      {"hoehegrund", Meaning::ground},
      {"gelaendepunkt", Meaning::ground},
      {"b3_h_dak_70p", Meaning::roof},
      {"hoehedach", Meaning::roof},
      {"dach_max", Meaning::high_roof},
      {"b3_h_dak_max", Meaning::high_roof},
      {"b3_h_dak_50p", Meaning::low_roof},
      {"hoehe", Meaning::height},
      {"h\xC3\xB6he", Meaning::height},
      {"hoogte", Meaning::height},
      {"altura", Meaning::height},
      {"altezza", Meaning::height},
      {"storeys", Meaning::storeys},
      {"stories", Meaning::storeys},
      {"levels", Meaning::storeys},
      {"building:levels", Meaning::storeys},
      {"building_levels", Meaning::storeys},
      {"floors", Meaning::storeys},
      {"num_floors", Meaning::storeys},
      {"floor_count", Meaning::storeys},
      {"numberoffloors", Meaning::storeys},
      {"number_of_floors", Meaning::storeys},
      {"numberoffloorsaboveground", Meaning::storeys},
      {"numberofstoreys", Meaning::storeys},
      {"number_of_storeys", Meaning::storeys},
      {"geschosse", Meaning::storeys},
      {"anzahlgeschosse", Meaning::storeys},
      {"anzahl_geschosse", Meaning::storeys},
      {"geschossanzahl", Meaning::storeys},
      {"vollgeschosse", Meaning::storeys},
      {"nombre_d_etages", Meaning::storeys},
      {"nb_etages", Meaning::storeys},
      {"bouwlagen", Meaning::storeys},
  };
  return table;
}

}  // namespace

bool NamedHeights::knows(std::string_view name) {
  return meanings().contains(name);
}

void NamedHeights::take(std::string_view name, std::string_view value, std::string_view unit) {
  const auto found = meanings().find(name);
  if (found == meanings().end()) return;
  const Meaning meaning = found->second;
  if (meaning == Meaning::height) {
    constexpr double max_height_m = 5000;
    const auto metres = parse_length_m(value, unit);
    if (metres && *metres > 0 && *metres < max_height_m) height_m_ = metres;
    return;
  }
  const auto number = parse_measure(value);
  if (!number || is_sentinel(*number)) return;
  if (meaning == Meaning::storeys) {
    constexpr double max_storeys = 200;
    if (*number >= 1 && *number <= max_storeys)
      storeys_ = std::max(storeys_.value_or(0), static_cast<int>(std::lround(*number)));
  } else if (meaning == Meaning::ground) {
    ground_ = number;
  } else {
    roofs_[meaning == Meaning::roof ? 0 : meaning == Meaning::low_roof ? 1 : 2] = number;
  }
}

std::optional<double> NamedHeights::find_height_m(double elevation_unit_m) const {
  if (height_m_) return height_m_;
  const auto is_known = [](const std::optional<double>& z) { return z.has_value(); };
  const auto roof = std::find_if(roofs_.begin(), roofs_.end(), is_known);
  if (!ground_ || roof == roofs_.end() || **roof <= *ground_) return {};
  return (**roof - *ground_) * elevation_unit_m;
}

}  // namespace nightcity::city
