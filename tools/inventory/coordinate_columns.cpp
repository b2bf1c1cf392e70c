#include "tools/inventory/coordinate_columns.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "formats/to_lower.h"
#include "tools/city/text_encoding.h"
#include "tools/inventory/vector_file.h"

namespace nightcity::inventory {
namespace {

using std::string_view;

struct Pair {
  string_view x, y;
};
// Names without blanks and signs, best first. Words for length and width alone are none: lamps have
// both.
constexpr std::array pairs{Pair{"lon", "lat"},
                           Pair{"long", "lat"},
                           Pair{"lng", "lat"},
                           Pair{"longitude", "latitude"},
                           Pair{"x", "y"},
                           Pair{"easting", "northing"},
                           Pair{"laengengrad", "breitengrad"},
                           Pair{"längengrad", "breitengrad"},
                           Pair{"geolaenge", "geobreite"},
                           Pair{"geolänge", "geobreite"},
                           Pair{"rechtswert", "hochwert"},
                           Pair{"ostwert", "nordwert"},
                           Pair{"longitud", "latitud"},
                           Pair{"longitudine", "latitudine"},
                           Pair{"lengtegraad", "breedtegraad"},
                           Pair{"længdegrad", "breddegrad"},
                           Pair{"lengdegrad", "breddegrad"},
                           Pair{"dlugosc", "szerokosc"},
                           Pair{"długość", "szerokość"},
                           Pair{"zemdelka", "zemsirka"},
                           Pair{"zeměpisnádélka", "zeměpisnášířka"},
                           Pair{"delka", "sirka"},
                           Pair{"долгота", "широта"},
                           Pair{"Долгота", "Широта"},
                           Pair{"γεωγραφικόμήκος", "γεωγραφικόπλάτος"},
                           Pair{"Γεωγραφικόμήκος", "Γεωγραφικόπλάτος"},
                           Pair{"経度", "緯度"},
                           Pair{"经度", "纬度"},
                           Pair{"經度", "緯度"},
                           Pair{"경도", "위도"},
                           Pair{"rechts", "hoch"},
                           Pair{"ost", "nord"},
                           Pair{"est", "nord"},
                           Pair{"este", "norte"},
                           Pair{"ita", "pohjoinen"},
                           Pair{"itä", "pohjoinen"},
                           Pair{"e", "n"}};

// Words that say more of a coordinate.
constexpr std::array<string_view, 54> qualifiers{
    "coordinates", "coordinate", "coordenadas", "coordenada", "coordonnees", "coordonnee",
    "coordinata",  "coord",      "koordinaten", "koordinate", "koordinat",   "koord",
    "geographic",  "geometry",   "geom",        "geo",        "gps",         "wgs84",
    "wgs",         "etrs89",     "utm",         "epsg",       "decimal",     "dec",
    "degrees",     "degree",     "deg",         "dd",         "°",           "position",
    "pos",         "point",      "location",    "loc",        "centroid",    "center",
    "centre",      "map",        "grid",        "gis",        "lv95",        "2d",
    "coords",      "xy",         "m",           "rd",         "lambert",     "lamb",
    "l93",         "jtsk",       "tm35fin",     "sweref99",   "puwg",        "gk"};

// Each place where words may end is looked at once, however many ways lead there.
bool are_qualifiers(string_view text) {
  std::vector<bool> ends(text.size() + 1);
  ends[0] = true;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!ends[at]) continue;
    const string_view rest = text.substr(at);
    for (const string_view word : qualifiers)
      if (rest.starts_with(word)) ends[at + word.size()] = true;
    // The number of a zone.
    for (const string_view word : {"utm", "utmzone", "zone", "gk", "lambert"}) {
      const string_view behind = rest.starts_with(word) ? rest.substr(word.size()) : string_view();
      const std::size_t digits = std::min(behind.find_first_not_of("0123456789"), behind.size());
      if (digits < 1 || digits > 2) continue;
      ends[at + word.size() + digits] = true;
      const bool has_band =
          behind.size() > digits && behind[digits] >= 'a' && behind[digits] <= 'z';
      if (has_band) ends[at + word.size() + digits + 1] = true;
    }
    // The number of a CRS.
    constexpr std::size_t least = 4, most = 6;
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
    if (digits >= least && digits <= most) ends[at + digits] = true;
  }
  return ends.back();
}

// Returns a column's name in lower case without blanks and signs, nor what stands in brackets.
std::string simplify_heading(const std::string& name) {
  constexpr std::size_t longest = 60;
  const std::string whole = to_lower(city::decode_text(name));
  std::string simple;
  // Lengths and widths in degrees are those of the Earth.
  for (const char* word : {"breite", "länge", "laenge"})
    if (whole.starts_with(word) && whole.find("°") != std::string::npos) simple = "geo";
  for (const char c : whole.substr(0, whole.find_first_of("([", 1)))
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80)
      simple += c;
  return simple.size() > longest ? std::string() : simple;
}

int find(const std::vector<std::string>& names, string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

// Finds the pair with the same words beside both.
CoordinateColumns find_qualified(const std::vector<std::string>& names, const Pair& pair) {
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t at = names[i].find(pair.x); at != std::string::npos;
         at = names[i].find(pair.x, at + 1)) {
      const string_view name = names[i], before = name.substr(0, at),
                        after = name.substr(at + pair.x.size());
      if (!are_qualifiers(before) || !are_qualifiers(after)) continue;
      const int y = find(names, std::string(before) + std::string(pair.y) + std::string(after));
      if (y >= 0) return {static_cast<int>(i), y};
    }
  return {};
}

CoordinateColumns find_among(const std::vector<std::string>& names) {
  for (const Pair& pair : pairs)
    if (const CoordinateColumns found{find(names, pair.x), find(names, pair.y)};
        found.x >= 0 && found.y >= 0)
      return found;
  for (const Pair& pair : pairs)
    if (const CoordinateColumns found = find_qualified(names, pair); found.y >= 0) return found;
  return {};
}

bool is_name_of_geometries(const std::string& name) {
  const std::string lower = to_lower(name);
  std::string_view rest = geometry_names;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    if (lower == rest.substr(0, comma)) return true;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return false;
}

}  // namespace

CoordinateColumns find_coordinate_columns(OGRFeatureDefn& columns) {
  std::vector<std::string> names;
  for (int i = 0; i < columns.GetFieldCount(); ++i)
    names.emplace_back(columns.GetFieldDefn(i)->GetNameRef());
  return find_coordinate_columns(names);
}

CoordinateColumns find_coordinate_columns(const std::vector<std::string>& names) {
  std::vector<std::string> simple;
  for (const std::string& name : names) simple.push_back(simplify_heading(name));
  return find_among(simple);
}

bool is_name_of_points(std::string_view name) {
  // OpenDataSoft's, Socrata's and ArcGIS Hub's, without blanks and underscores.
  constexpr std::array<std::string_view, 7> names{"geopoint2d", "geopoint",    "latlon",  "latlng",
                                                  "latlong",    "coordinates", "location"};
  std::string simple = to_lower(name);
  std::erase_if(simple, [](char c) { return c == ' ' || c == '_'; });
  return std::find(names.begin(), names.end(), simple) != names.end();
}

bool puts_latitude_first(std::string_view name) {
  const std::string lower = to_lower(name);
  return lower.starts_with("geo_point") || lower.starts_with("lat");
}

bool have_names_of_places(const std::vector<std::string>& names) {
  return find_coordinate_columns(names).x >= 0 ||
         std::any_of(names.begin(), names.end(), is_name_of_points) ||
         std::any_of(names.begin(), names.end(), is_name_of_geometries);
}

}  // namespace nightcity::inventory
