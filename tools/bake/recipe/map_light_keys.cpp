#include <string>

#include "tools/bake/recipe/tables.h"

namespace nightcity::recipe {
namespace {

using map_lights::MapLightKind;

MapLightKind to_kind(const Value& value, const std::string& name) {
  if (const auto kind = map_lights::find_kind(name)) return *kind;
  std::string names;
  for (std::size_t n = 0; n < map_lights::map_light_kind_count; ++n)
    names += (n == 0 ? "" : ", ") + std::string(name_of(static_cast<MapLightKind>(n)));
  value.refuse("names no kind of light of the map: those are " + names);
}

std::map<MapLightKind, lights::NightSpan> to_dark_spans(const Value& value) {
  std::map<MapLightKind, lights::NightSpan> result;
  for (const auto& [name, row] : value.rows("a table like {advertising = \"01:00-06:00\"}")) {
    const MapLightKind kind = to_kind(row, name);
    const auto span = lights::parse_night_span(row.text());
    if (!span) row.refuse("is no span of the night like \"23:00-05:00\", between 17:00 and 07:00");
    result[kind] = *span;
  }
  return result;
}

Key without_key(std::set<MapLightKind>& kinds) {
  return {"without",
          "string or list of strings",
          "",
          "",
          R"("advertising", "floodlit", "pitch", "petrol_station")",
          R"(["petrol_station"])",
          "Kinds of light that the city does not get.",
          [&kinds](const Value& value) {
            kinds.clear();
            for (const std::string& name : value.texts()) kinds.insert(to_kind(value, name));
          }};
}

Key off_key(std::map<MapLightKind, lights::NightSpan>& spans) {
  return {"off",
          "table: kind = \"HH:MM-HH:MM\"",
          "",
          "local time",
          "within 17:00 to 07:00",
          R"({advertising = "01:00-06:00"})",
          "Every light of these kinds is dark in the span, unless its own tags say otherwise. "
          "Without it advertising shines all night, floodlit buildings until 23:00, pitches until "
          "22:00, and petrol stations are dark from 22:00 to 06:00.",
          [&spans](const Value& value) { spans = to_dark_spans(value); }};
}

}  // namespace

Table make_map_light_table(map_lights::MapLightOptions& lights) {
  return {"map_lights",
          "Lights of the map that are no street lamps: `advertising`, what is `floodlit`, pitches "
          "and stadiums with `lit=yes`, and petrol stations (docs/lights.md).",
          {flag_key("lit", lights.lit, "Whether the city gets such lights at all."),
           without_key(lights.without), off_key(lights.off)}};
}

}  // namespace nightcity::recipe
