#include "tools/lights/lamp_tags.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "formats/colour.h"
#include "tools/lights/lamp_state.h"
#include "tools/lights/lamp_tag_words.h"
#include "tools/lights/lit_tag.h"
#include "tools/osm/bearings.h"
#include "tools/osm/colour_words.h"
#include "tools/osm/tag_values.h"
#include "tools/today.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr double least_cct_k = 1000;

std::optional<LampMount> parse_mount(string_view text) {
  for (const string_view part : osm::split_list(text))
    if (const auto mount = find_lamp_mount(osm::normalise_tag(part))) return mount;
  return std::nullopt;
}

/// Returns a parser that accepts what `parse` reads if it lies within the bounds.
template <class Parse>
auto between(double low, double high, Parse parse) {
  return [=](string_view text) -> std::optional<double> {
    const auto value = parse(text);
    return value && *value >= low && *value <= high ? value : std::nullopt;
  };
}

/// Returns a parser of numbers without a unit or with one of these.
auto number_in(std::initializer_list<string_view> units) {
  return [units = std::vector<string_view>(units)](string_view text) -> std::optional<double> {
    const auto value = osm::take_number(text);
    const std::string unit = osm::normalise_tag(text);
    const bool known = unit.empty() || std::find(units.begin(), units.end(), unit) != units.end();
    return value && known ? value : std::nullopt;
  };
}

std::optional<double> parse_lamp_count(string_view text) {
  constexpr std::pair<string_view, double> words[] = {{"one", 1},    {"single", 1}, {"two", 2},
                                                      {"double", 2}, {"twin", 2},   {"three", 3},
                                                      {"triple", 3}, {"four", 4}};
  const std::string word = osm::normalise_tag(text);
  for (const auto& [name, count] : words)
    if (word == name) return count;
  return number_in({"lamps", "lights", "luminaires"})(text);
}

class LampTagReader {
 public:
  LampTagReader(const osm::OsmTags& tags, Half half) : tags_(tags), half_(half) {}

  LampTags read() {
    read_switching();
    read_source();
    read_place();
    read_colour();
    read_aim();
    return std::move(lamp_);
  }

 private:
  const std::string* find(const char* key) const {
    const auto found = tags_.find(key);
    return found == tags_.end() ? nullptr : &found->second;
  }

  bool says(const char* key, std::initializer_list<string_view> values) const {
    const std::string* text = find(key);
    return text &&
           std::find(values.begin(), values.end(), osm::normalise_tag(*text)) != values.end();
  }

  void count_unread(const char* key, string_view text) {
    ++lamp_.unread[std::string(key) + "=" + std::string(text)];
  }

  /// Returns the value of the first key that can be read, and counts those before it that cannot.
  template <class Parse>
  auto first_of(std::initializer_list<const char*> keys, Parse parse)
      -> decltype(parse(string_view())) {
    for (const char* key : keys) {
      const std::string* text = find(key);
      if (!text) continue;
      if (const auto value = parse(string_view(*text))) return value;
      count_unread(key, *text);
    }
    return std::nullopt;
  }

  void read_switching() {
    lamp_.outage = find_outage(tags_, today(), lamp_.unread);
    for (const char* key : {"lit", "light:lit"}) {
      const LitTags read = read_lit_tags(tags_, key, half_);
      for (const std::string& text : read.unread) ++lamp_.unread[text];
      if (read.lit.kind == LitTag::Kind::dark) lamp_.outage = "lit=no";
      if (!lamp_.hours) lamp_.hours = read.lit.hours;
    }
    lamp_.unlit = !lamp_.outage.empty();
  }

  /// Heights and what the lamp is mounted on.
  void read_place() {
    lamp_.mast = says("tower:type", {"lighting"}) ||
                 says("light_source", {"floodlight", "flood_light"}) ||
                 says("man_made", {"floodlight", "light_mast", "lighting_mast"});
    lamp_.height_m =
        first_of({"light:height", "lamp:height", "lamp_height", "light:mounting_height",
                  "mounting_height", "height", "pole:height", "est_height"},
                 between(0.3, 60, osm::parse_length_m));
    lamp_.ele_m = first_of({"ele"}, between(-500, 9000, osm::parse_length_m));
    lamp_.mount = first_of({"light:mount", "lamp_mount", "lamp:mount", "support"}, parse_mount);
    // Berlin's mapping numbers the arms of a mount here: a count, not a mount that is not
    // understood.
    std::erase_if(lamp_.unread, [](const auto& entry) {
      return entry.first.starts_with("light:mount=") && entry.first.size() == 13;
    });
  }

  /// Returns the watts of one luminaire from "2x36 W": of two where the post has as many.
  std::optional<double> read_watts(string_view text) const {
    const auto watts = osm::parse_watts(text);
    const std::string* count = find("light:count");
    if (!watts || !count) return watts;
    const double factor = osm::take_factor(text);
    string_view number = *count;
    return osm::take_number(number) == factor ? std::optional(*watts / factor) : watts;
  }

  /// Type of lamp, flux and power.
  void read_source() {
    if (const std::string* model = find("luminaire_model")) lamp_.model = *model;
    lamp_.flux_lm = first_of(
        {"light:luminous_flux", "luminous_flux", "light:lumen", "light:lumens", "lumen", "lumens"},
        between(10, 200000, osm::parse_lumens));
    lamp_.power_w =
        first_of({"light:power", "lamp_power", "lamp:power", "wattage", "light:wattage",
                  "lamp:wattage", "lamp_wattage", "power:rating"},
                 between(1, 2000, [this](string_view text) { return read_watts(text); }));
    lamp_.type =
        first_of({"light:method", "lamp_type", "light:type", "light_type"}, parse_lamp_type);
    // "electric" only says that it is not gas, but it is no mistake.
    std::erase_if(lamp_.unread, [](const auto& entry) {
      return entry.first.ends_with("=electric") || entry.first.ends_with("=electrical");
    });
    if (says("fake_gaslight", {"yes"}) || says("electric", {"led"})) lamp_.type = LampType::led;
    const auto flames = first_of({"lamp_flames"}, between(1, 24, number_in({})));
    if (!flames || lamp_.type == LampType::led) return;
    lamp_.type = LampType::gas;
    if (!lamp_.flux_lm) lamp_.flux_lm = *flames * gas_lumen_per_flame;
  }

  void read_colour() {
    for (const char* key :
         {"light:colour", "light:color", "lamp:colour", "colour:light", "light:colour_temperature",
          "colour_temperature", "light:color_temperature", "color_temperature", "light:temperature",
          "light:colour:temperature"}) {
      const std::string* text = find(key);
      if (!text) continue;
      for (const string_view part : osm::split_list(*text))
        if (read_colour(part)) return;
      count_unread(key, *text);
    }
  }

  bool read_colour(string_view text) {
    const std::string word = osm::normalise_tag(text);
    if (word == "orange" || word == "yellow" || word == "amber") {
      lamp_.colour = rec709_from_xy(*lamp_type_defaults(LampType::high_pressure_sodium).xy);
      return true;
    }
    lamp_.cct_k = parse_cct_k(text);  // "white" is one of lamps
    if (lamp_.cct_k) return true;
    if (const auto rgb = osm::parse_colour(text)) lamp_.colour = rec709_from_rgb(*rgb);
    return lamp_.colour.has_value();
  }

  /// Directions, tilt and the number of luminaires: at least one for each direction.
  void read_aim() {
    constexpr std::size_t max_count = 12;
    for (const char* key : {"light:direction", "direction"}) {
      const std::string* text = find(key);
      if (!text || !lamp_.directions_degrees.empty()) continue;
      osm::Bearings bearings = osm::parse_bearings(*text);
      for (const std::string& part : bearings.unread) count_unread(key, part);
      if (bearings.degrees.size() > max_count) {
        count_unread(key, *text);
        bearings.degrees.clear();
      }
      lamp_.directions_degrees = std::move(bearings.degrees);
    }
    lamp_.tilt_degrees = first_of({"light:tilt"}, between(-90, 90, number_in({"\xc2\xb0", "deg"})));
    if (lamp_.tilt_degrees)
      *lamp_.tilt_degrees += 90;  // OSM counts from the horizontal: -90 is straight down
    const auto count = first_of({"light:count", "lamp_count", "lamp:count", "lamps"},
                                between(1, static_cast<double>(max_count), parse_lamp_count));
    lamp_.count = static_cast<int>(
        std::max<std::size_t>({1, count ? static_cast<std::size_t>(std::lround(*count)) : 1,
                               lamp_.directions_degrees.size()}));
  }

  const osm::OsmTags& tags_;
  Half half_;
  LampTags lamp_;
};

}  // namespace

namespace {

// Makers' codes for colours of light are the tens of the colour rendering index and the hundreds of
// the temperature: 830 is a rendering above 80 at 3000 K.
std::optional<double> parse_colour_code(string_view word) {
  if (word.size() != 3 || word[0] < '6' || word[0] > '9') return std::nullopt;
  string_view behind = word.substr(1);
  const auto hundreds = osm::take_number(behind);
  const bool fits = hundreds && behind.empty() && *hundreds >= 18 && *hundreds <= 65;
  return fits ? std::optional(100 * *hundreds) : std::nullopt;
}

}  // namespace

std::optional<double> parse_cct_k(string_view text) {
  for (string_view part : osm::split_list(text)) {
    if (const auto known = find_cct_k(osm::normalise_tag(part))) return known;
    if (const auto of_code = parse_colour_code(part)) return of_code;
    const std::string plain = osm::to_plain_signs(part);
    part = plain;
    if ((part.starts_with('K') || part.starts_with('k')) && part.size() > 1) part.remove_prefix(1);
    auto value = osm::take_amount(part, least_cct_k);
    if (value && part.starts_with("-")) {  // a range
      part.remove_prefix(1);
      const auto upper = osm::take_amount(part, least_cct_k);
      value = upper ? std::optional((*value + *upper) / 2) : std::nullopt;
    }
    const std::string unit = osm::normalise_tag(part);
    if (value &&
        (unit.empty() || unit == "k" || unit == "kelvin" || unit == "\xc2\xb0k" || unit == "К" ||
         unit == "к") &&
        *value >= least_cct_k && *value <= 20000)
      return value;
  }
  return std::nullopt;
}

std::optional<LampType> parse_lamp_type(string_view text) {
  for (const string_view part : osm::split_list(text)) {
    if (const auto type = find_lamp_type(osm::normalise_tag(part))) return type;
    // "HPS 150W", "LED 4000K"
    const std::size_t blank = part.find(' ');
    if (blank + 1 < part.size() && blank != part.npos && part[blank + 1] >= '0' &&
        part[blank + 1] <= '9')
      if (const auto type = find_lamp_type(osm::normalise_tag(part.substr(0, blank)))) return type;
  }
  return std::nullopt;
}

LampTags read_lamp_tags(const osm::OsmTags& tags, Half half) {
  return LampTagReader(tags, half).read();
}

}  // namespace nightcity::lights
