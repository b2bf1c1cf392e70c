#include "tools/lights/lamp_tags.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tools/lights/colour.h"
#include "tools/osm/tag_values.h"
#include "tools/osm/tag_values.h"

namespace nightcity {
namespace {

using std::string_view;

template <class Value, std::size_t N>
std::optional<Value> look_up(const std::string& word,
                             const std::array<std::pair<string_view, Value>, N>& table) {
  for (const auto& [name, value] : table)
    if (word == name) return value;
  return std::nullopt;
}

std::optional<LampMount> parse_mount(string_view text) {
  static constexpr std::array<std::pair<string_view, LampMount>, 27> words = {{
      {"straight_mast", LampMount::straight_mast},
      {"mast", LampMount::straight_mast},
      {"straight", LampMount::straight_mast},
      {"pole", LampMount::straight_mast},
      {"power_pole", LampMount::bent_mast},
      {"utility_pole", LampMount::bent_mast},
      {"cast_steel_mast", LampMount::straight_mast},
      {"post", LampMount::straight_mast},
      {"high_mast", LampMount::straight_mast},
      {"column", LampMount::straight_mast},
      {"bent_mast", LampMount::bent_mast},
      {"bent", LampMount::bent_mast},
      {"bend_mast", LampMount::bent_mast},
      {"curved_mast", LampMount::bent_mast},
      {"wall", LampMount::wall},
      {"wall_mounted", LampMount::wall},
      {"wall_mount", LampMount::wall},
      {"facade", LampMount::wall},
      {"ceiling", LampMount::wall},
      {"suspended", LampMount::suspended},
      {"wire", LampMount::suspended},
      {"wires", LampMount::suspended},
      {"catenary", LampMount::suspended},
      {"power_line", LampMount::suspended},
      {"ground", LampMount::bollard},
      {"bollard", LampMount::bollard},
      {"floor", LampMount::bollard},
  }};
  for (const string_view part : split_list(text))
    if (const auto mount = look_up(normalise_tag(part), words)) return mount;
  return std::nullopt;
}

}  // namespace

std::optional<double> parse_cct_k(string_view text) {
  // Names after the usual market classes (warm 2700-3000, neutral 4000, cool 5000-6500 K).
  static constexpr std::array<std::pair<string_view, double>, 12> words = {{{"warm_white", 2850},
                                                                            {"warm", 2850},
                                                                            {"warmwhite", 2850},
                                                                            {"warm_light", 2850},
                                                                            {"neutral_white", 4000},
                                                                            {"neutral", 4000},
                                                                            {"white", 4000},
                                                                            {"cool_white", 5500},
                                                                            {"cold_white", 5500},
                                                                            {"cold", 5500},
                                                                            {"cool", 5500},
                                                                            {"daylight", 6500}}};
  for (string_view part : split_list(text)) {
    if (const auto known = look_up(normalise_tag(part), words)) return known;
    const auto value = take_number(part);
    const std::string unit = normalise_tag(part);
    if (value && (unit.empty() || unit == "k" || unit == "kelvin") && *value >= 1000 &&
        *value <= 20000)
      return value;
  }
  return std::nullopt;
}

std::optional<double> parse_direction_degrees(string_view text) {
  static constexpr std::array<std::pair<string_view, double>, 24> points = {
      {{"n", 0},           {"nne", 22.5},       {"ne", 45},          {"ene", 67.5},
       {"e", 90},          {"ese", 112.5},      {"se", 135},         {"sse", 157.5},
       {"s", 180},         {"ssw", 202.5},      {"sw", 225},         {"wsw", 247.5},
       {"w", 270},         {"wnw", 292.5},      {"nw", 315},         {"nnw", 337.5},
       {"north", 0},       {"east", 90},        {"south", 180},      {"west", 270},
       {"north_east", 45}, {"south_east", 135}, {"south_west", 225}, {"north_west", 315}}};
  if (const auto known = look_up(normalise_tag(text), points)) return known;
  const auto value = take_number(text);
  const std::string unit = normalise_tag(text);
  if (!value || *value < -360 || *value > 360) return std::nullopt;
  if (!unit.empty() && unit != "\xc2\xb0" && unit != "deg" && unit != "degrees")
    return std::nullopt;
  return *value < 0 ? *value + 360 : *value == 360 ? 0 : *value;
}

std::optional<LampType> parse_lamp_type(string_view text) {
  using enum LampType;
  static constexpr std::array<std::pair<string_view, LampType>, 31> words = {{
      {"led", led},
      {"leds", led},
      {"light_emitting_diode", led},
      {"high_pressure_sodium", high_pressure_sodium},
      {"sodium_high_pressure", high_pressure_sodium},
      {"sodium", high_pressure_sodium},  // nine in ten sodium street lamps
      {"sodium_vapor", high_pressure_sodium},
      {"sodium_vapour", high_pressure_sodium},
      {"son", high_pressure_sodium},
      {"hps", high_pressure_sodium},
      {"hpsv", high_pressure_sodium},
      {"low_pressure_sodium", low_pressure_sodium},
      {"sox", low_pressure_sodium},
      {"lps", low_pressure_sodium},
      {"mercury", mercury},
      {"mercury_vapor", mercury},
      {"mercury_vapour", mercury},
      {"high_pressure_mercury", mercury},
      {"metal_halide", metal_halide},
      {"metal_halogen", metal_halide},
      {"hqi", metal_halide},
      {"discharge", high_pressure_sodium},
      {"fluorescent", fluorescent},
      {"fluorescent_lamp", fluorescent},
      {"compact_fluorescent", fluorescent},
      {"neon", fluorescent},
      {"incandescent", incandescent},
      {"halogen", incandescent},
      {"gas", gas},
      {"gaslight", gas},
      {"gas_light", gas},
  }};
  for (const string_view part : split_list(text))
    if (const auto type = look_up(normalise_tag(part), words)) return type;
  return std::nullopt;
}

LampTags read_lamp_tags(const OsmTags& tags) {
  LampTags lamp;
  const auto get = [&](const char* key) -> const std::string* {
    const auto found = tags.find(key);
    return found == tags.end() ? nullptr : &found->second;
  };
  // The first key that can be read wins; those that cannot are told about.
  const auto first_of = [&](std::initializer_list<const char*> keys,
                            auto parse) -> decltype(parse(string_view())) {
    for (const char* key : keys) {
      const std::string* text = get(key);
      if (!text) continue;
      if (const auto value = parse(string_view(*text))) return value;
      ++lamp.unread[std::string(key) + "=" + *text];
    }
    return std::nullopt;
  };
  const auto between = [](double low, double high, auto parse) {
    return [=](string_view text) -> std::optional<double> {
      const auto value = parse(text);
      return value && *value >= low && *value <= high ? value : std::nullopt;
    };
  };
  const auto plain = [](std::initializer_list<string_view> units) {
    return [units](string_view text) -> std::optional<double> {
      const auto value = take_number(text);
      const std::string unit = normalise_tag(text);
      const bool known = unit.empty() || std::find(units.begin(), units.end(), unit) != units.end();
      return value && known ? value : std::nullopt;
    };
  };

  const auto says = [&](const char* key, std::initializer_list<string_view> values) {
    const std::string* text = get(key);
    return text && std::find(values.begin(), values.end(), normalise_tag(*text)) != values.end();
  };
  lamp.unlit = says("lit", {"no", "disused", "broken"}) || says("light:lit", {"no"}) ||
               says("disused", {"yes"}) || says("abandoned", {"yes"});
  if (!lamp.unlit) {
    // Lamps that are not lit the whole night go dark in its middle: half-night switching.
    const NightSchedule part_time = dark_between(minute_of(23, 0), minute_of(5, 0));
    for (const char* key : {"lit", "light:lit"}) {
      const std::string* text = get(key);
      if (!text || says(key, {"yes", "automatic", "sunset_sunrise", "dusk_dawn"})) continue;
      if (says(key, {"limited", "interval", "half_night"}))
        lamp.hours = part_time;
      else
        lamp.hours = parse_lit_hours(*text);
      if (lamp.hours) break;
      ++lamp.unread[std::string(key) + "=" + *text];
    }
  }
  lamp.mast = says("tower:type", {"lighting"}) ||
              says("light_source", {"floodlight", "flood_light"}) ||
              says("man_made", {"floodlight", "light_mast", "lighting_mast"});

  lamp.height_m =
      first_of({"light:height", "height", "est_height"}, between(0.3, 60, parse_length_m));
  lamp.ele_m = first_of({"ele"}, between(-500, 9000, parse_length_m));
  lamp.flux_lm = first_of(
      {"light:luminous_flux", "luminous_flux", "light:lumen", "light:lumens", "lumen", "lumens"},
      between(10, 200000, plain({"lm", "lumen", "lumens"})));
  lamp.power_w = first_of({"light:power", "lamp_power", "lamp:power", "wattage", "power:rating"},
                          between(1, 2000, plain({"w", "watt", "watts"})));
  lamp.type = first_of({"light:method", "lamp_type", "light:type", "light_type"},
                       [](string_view text) { return parse_lamp_type(text); });
  // "electric" says no more than that it is not gas; it is no mistake either.
  std::erase_if(lamp.unread, [](const auto& entry) { return entry.first.ends_with("=electric"); });
  if (says("fake_gaslight", {"yes"}) || says("electric", {"led"})) lamp.type = LampType::led;
  if (const auto flames = first_of({"lamp_flames"}, between(1, 24, plain({})));
      flames && lamp.type != LampType::led) {
    lamp.type = LampType::gas;
    if (!lamp.flux_lm) lamp.flux_lm = *flames * gas_lumen_per_flame;
  }
  lamp.mount =
      first_of({"light:mount", "lamp_mount", "lamp:mount", "support"},
               [](string_view text) -> std::optional<LampMount> { return parse_mount(text); });
  // Berlin numbers its mounts' arms here; that is a count, not a mount.
  std::erase_if(lamp.unread, [](const auto& entry) {
    return entry.first.starts_with("light:mount=") && entry.first.size() == 13;
  });

  for (const char* key : {"light:colour", "light:color", "lamp:colour", "colour:light",
                          "light:colour_temperature", "colour_temperature"}) {
    const std::string* text = get(key);
    if (!text) continue;
    const std::string word = normalise_tag(*text);
    if (word == "orange" || word == "yellow" || word == "amber") {
      lamp.colour = rec709_from_xy(*lamp_type_defaults(LampType::high_pressure_sodium).xy);
    } else if (const auto colour = rec709_from_hex(word)) {
      lamp.colour = colour;
    } else if (const auto kelvin = parse_cct_k(*text)) {
      lamp.cct_k = kelvin;
    } else {
      ++lamp.unread[std::string(key) + "=" + *text];
      continue;
    }
    break;
  }

  for (const char* key : {"light:direction", "direction"}) {
    const std::string* text = get(key);
    if (!text || !lamp.directions_degrees.empty()) continue;
    for (const string_view part : split_list(*text)) {
      if (const auto degrees = parse_direction_degrees(part))
        lamp.directions_degrees.push_back(*degrees);
      else
        ++lamp.unread[std::string(key) + "=" + std::string(part)];
    }
  }
  lamp.tilt_degrees = first_of({"light:tilt"}, between(-90, 90, plain({"\xc2\xb0", "deg"})));
  if (lamp.tilt_degrees)
    *lamp.tilt_degrees += 90;  // OSM counts from the horizon, -90 straight down

  const auto count = first_of({"light:count", "lamp_count"}, between(1, 12, plain({})));
  if (count)
    lamp.count = static_cast<int>(std::lround(*count));
  else
    lamp.count = static_cast<int>(std::clamp<std::size_t>(lamp.directions_degrees.size(), 1, 12));
  return lamp;
}

}  // namespace nightcity
