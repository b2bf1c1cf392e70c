#include "tools/bake/recipe/recipe.h"

#include <toml++/toml.h>
#include <algorithm>
#include <limits>
#include <map>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "tools/bake/city/city_files.h"
#include "tools/bake/recipe/lamp_keys.h"
#include "tools/bake/recipe/value.h"
#include "tools/lights/night_schedule.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;
using namespace recipe;

std::vector<fs::path> files_of(const Setting& setting, const fs::path& folder,
                               bool expand_folders) {
  std::vector<fs::path> result;
  for (const std::string& name : setting.texts()) {
    if (name.empty()) setting.refuse("holds an empty name");
    const fs::path path = (folder / name).lexically_normal();
    const auto found = expand_folders ? city_files(path) : std::vector<fs::path>{path};
    result.insert(result.end(), found.begin(), found.end());
  }
  if (result.empty()) setting.refuse("names no file");
  return result;
}

std::vector<CityFrame::ControlPoint> control_points(const Setting& setting) {
  const toml::array* rows = setting.node.as_array();
  if (!rows || rows->size() < 2) setting.refuse("is not a list of two or more [lon, lat, x, y]");
  std::vector<CityFrame::ControlPoint> result;
  for (const toml::node& row : *rows) {
    const toml::array* values = row.as_array();
    if (!values || values->size() != 4)
      Setting{setting.file, setting.name, row}.refuse("holds a row that is not [lon, lat, x, y]");
    double v[4];
    for (std::size_t i = 0; i < 4; ++i)
      v[i] = Setting{setting.file, setting.name, (*values)[i]}.number(-1e9, 1e9);
    result.push_back({{v[0], v[1]}, {v[2], v[3]}});
  }
  return result;
}

std::array<double, 4> bounds(const Setting& setting) {
  const toml::array* values = setting.node.as_array();
  if (!values || values->size() != 4) setting.refuse("is not [west, south, east, north]");
  std::array<double, 4> result{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double most = i % 2 == 0 ? 180 : 90;
    result[i] = Setting{setting.file, setting.name, (*values)[i]}.number(-most, most);
  }
  if (!(result[0] < result[2] && result[1] < result[3])) setting.refuse("has no extent");
  return result;
}

// "22:00" as minutes after 17:00; the night ends at 07:00.
int minute_of_night(const Setting& setting) {
  const std::string text = setting.text();
  const auto digit = [&text](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  if (text.size() != 5 || text[2] != ':' || !digit(0) || !digit(1) || !digit(3) || !digit(4))
    setting.refuse("is not a time like \"22:00\"");
  const int hour = (text[0] - '0') * 10 + text[1] - '0',
            minute = (text[3] - '0') * 10 + text[4] - '0';
  if (hour > 23 || minute > 59) setting.refuse("is not a time like \"22:00\"");
  const int after = minute_of(hour, minute);
  if (after >= night_minutes) setting.refuse("is not between 17:00 and 07:00");
  return after;
}

traffic::Side side_of_road(const Setting& setting) {
  const std::string name = setting.text();
  if (name == "right") return traffic::Side::right;
  if (name == "left") return traffic::Side::left;
  setting.refuse("is neither \"left\" nor \"right\"");
}

// Shares of the busiest hour at noon, 13:00, ... 11:00.
std::array<float, 24> shares_by_hour(const Setting& setting) {
  const toml::array* rows = setting.node.as_array();
  std::array<float, 24> result{};
  if (!rows || rows->size() != result.size())
    setting.refuse("is not a list of 24 shares from noon on");
  for (std::size_t hour = 0; hour < result.size(); ++hour)
    result[hour] =
        static_cast<float>(Setting{setting.file, setting.name, (*rows)[hour]}.number(0, 1));
  if (*std::max_element(result.begin(), result.end()) <= 0)
    setting.refuse("leaves no hour with any traffic");
  return result;
}

std::map<std::string, Table> tables_of(Recipe& recipe) {
  const fs::path folder = recipe.path.parent_path();
  Recipe::City& city = recipe.city;
  const auto origin = [](std::optional<double>& value) {
    return [&value](const Setting& s) { value = s.number(-1e8, 1e8); };
  };
  return {
      {"city",
       {{"files", [&city, folder](const Setting& s) { city.files = files_of(s, folder, true); }},
        {"crs", [&city](const Setting& s) { city.frame.crs_override = s.text(); }},
        {"control_points",
         [&city](const Setting& s) { city.frame.control_points = control_points(s); }},
        {"bounds", [&city](const Setting& s) { city.bounds = bounds(s); }},
        {"lod", [&city](const Setting& s) { city.read.highest_lod = s.integer(0, 4); }},
        {"threads",
         [&city](const Setting& s) {
           city.read.threads = static_cast<unsigned>(s.integer(0, 1024));
         }},
        {"tile_m", [&city](const Setting& s) { city.tile_m = s.number(10, 10000); }},
        {"drop_ground", [&city](const Setting& s) { city.drop_ground = s.boolean(); }},
        {"drop_hidden", [&city](const Setting& s) { city.drop_hidden = s.boolean(); }},
        {"licence", [&city](const Setting& s) { city.licences = s.texts(); }},
        {"reader",
         [&city](const Setting& s) {
           const std::string name = s.text();
           if (name != "stream" && name != "libcitygml")
             s.refuse("is neither \"stream\" nor \"libcitygml\"");
           city.read.reader = name == "stream" ? Reader::stream : Reader::libcitygml;
         }}}},
      {"osm",
       {{"files",
         [&recipe, folder](const Setting& s) { recipe.osm.files = files_of(s, folder, false); }},
        {"licence", [&recipe](const Setting& s) { recipe.osm.licence = s.text(); }}}},
      {"lamps", lamp_settings(recipe.lamps, folder)},
      {"terrain",
       {{"dem",
         [&recipe, folder](const Setting& s) { recipe.terrain.dem = files_of(s, folder, false); }},
        {"make_surface",
         [&recipe](const Setting& s) { recipe.terrain.make_surface = s.boolean(); }},
        {"margin_m",
         [&recipe](const Setting& s) { recipe.terrain.margin_m = s.number(0, 10000); }}}},
      {"origin",
       {{"easting", origin(recipe.origin.easting)},
        {"northing", origin(recipe.origin.northing)},
        {"height", origin(recipe.origin.height)}}},
      {"windows",
       {{"lit", [&recipe](const Setting& s) { recipe.windows.lit = s.boolean(); }},
        {"seed",
         [&recipe](const Setting& s) {
           recipe.windows.seed =
               static_cast<std::uint64_t>(s.integer(0, std::numeric_limits<int>::max()));
         }}}},
      {"traffic",
       {{"drives", [&recipe](const Setting& s) { recipe.traffic.drives = s.boolean(); }},
        {"vehicles",
         [&recipe](const Setting& s) { recipe.traffic.options.vehicles = s.number(0, 1e6); }},
        {"per_km",
         [&recipe](const Setting& s) { recipe.traffic.options.per_km = s.number(0, 100); }},
        {"cycle_s",
         [&recipe](const Setting& s) { recipe.traffic.options.cycle_s = s.number(60, 86400); }},
        {"side", [&recipe](const Setting& s) { recipe.traffic.options.side = side_of_road(s); }},
        {"hours",
         [&recipe](const Setting& s) { recipe.traffic.options.hours = shares_by_hour(s); }},
        {"seed",
         [&recipe](const Setting& s) {
           recipe.traffic.options.seed =
               static_cast<std::uint64_t>(s.integer(0, std::numeric_limits<int>::max()));
         }}}},
      {"night",
       {{"time", [&recipe](const Setting& s) { recipe.night.minute = minute_of_night(s); }}}},
      {"output",
       {{"draco", [&recipe](const Setting& s) { recipe.output.draco = s.boolean(); }},
        {"draco_tolerance_m",
         [&recipe](const Setting& s) { recipe.output.draco_tolerance_m = s.number(1e-5, 10); }},
        {"punctual",
         [&recipe](const Setting& s) {
           recipe.output.punctual = static_cast<std::size_t>(s.integer(0, 1'000'000));
         }}}},
  };
}

template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

[[noreturn]] void unknown(const std::string& file, const toml::key& key, const std::string& what,
                          const std::vector<std::string>& known) {
  std::string message = "unknown " + what;
  if (const std::string near = nearest_word(std::string(key.str()), known); !near.empty())
    message += "; did you mean \"" + near + "\"?";
  throw UsageError(file, "line " + std::to_string(key.source().begin.line), message);
}

}  // namespace

Recipe read_recipe(const fs::path& path) {
  const std::string file = path.string();
  const MappedFile mapped(path);
  const std::string_view text(reinterpret_cast<const char*>(mapped.bytes().data()),
                              mapped.bytes().size());
  toml::table document;
  try {
    document = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw Error(file, "line " + std::to_string(error.source().begin.line),
                "is not TOML: " + std::string(error.description()));
  }

  Recipe recipe;
  recipe.path = path;
  const auto tables = tables_of(recipe);
  for (const auto& [name, node] : document) {
    const std::string table_name(name.str());
    const auto table = tables.find(table_name);
    if (table == tables.end()) unknown(file, name, "table [" + table_name + "]", keys_of(tables));
    const toml::table* settings = node.as_table();
    if (table_name == "traffic") recipe.traffic.drives = true;
    if (!settings) Setting{file, table_name, node}.refuse("is not a table");
    for (const auto& [key, value] : *settings) {
      const std::string key_name = "[" + table_name + "] " + std::string(key.str());
      const auto handler = table->second.find(std::string(key.str()));
      if (handler == table->second.end())
        unknown(file, key, "key " + key_name, keys_of(table->second));
      handler->second(Setting{file, key_name, value});
    }
  }
  if (recipe.city.bounds && !recipe.city.frame.control_points.empty())
    throw UsageError(
        file, "[city] bounds and control_points both place the model: one of them is enough");
  if (recipe.city.files.empty() && recipe.osm.files.empty())
    throw UsageError(file, "names no city: [city] files = [\"...\"] is missing");
  return recipe;
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  // Damerau-Levenshtein distance, restricted to swaps of neighbours (optimal string alignment).
  const auto distance = [&word](const std::string& other) {
    const std::size_t width = other.size() + 1;
    std::vector<std::size_t> d((word.size() + 1) * width);
    for (std::size_t i = 0; i <= word.size(); ++i) d[i * width] = i;
    for (std::size_t j = 0; j < width; ++j) d[j] = j;
    for (std::size_t i = 1; i <= word.size(); ++i)
      for (std::size_t j = 1; j < width; ++j) {
        const std::size_t replaced =
            d[(i - 1) * width + j - 1] + (word[i - 1] != other[j - 1] ? 1 : 0);
        d[i * width + j] =
            std::min({d[(i - 1) * width + j] + 1, d[i * width + j - 1] + 1, replaced});
        if (i > 1 && j > 1 && word[i - 1] == other[j - 2] && word[i - 2] == other[j - 1])
          d[i * width + j] = std::min(d[i * width + j], d[(i - 2) * width + j - 2] + 1);
      }
    return d.back();
  };
  std::string best;
  std::size_t least =
      std::max<std::size_t>(2, word.size() / 2) + 1;  // farther than that it is another word
  for (const std::string& candidate : candidates)
    if (const std::size_t edits = distance(candidate); edits < least) {
      least = edits;
      best = candidate;
    }
  return best;
}

}  // namespace nightcity
