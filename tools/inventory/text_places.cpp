#include "tools/inventory/text_places.h"

#include <cpl_json.h>
#include <cpl_string.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/text_encoding.h"
#include "tools/inventory/coordinate_columns.h"
#include "tools/inventory/degrees_text.h"
#include "tools/inventory/vector_file.h"
#include "tools/osm/tag_values.h"

namespace nightcity::inventory {
namespace {

// Returns the first column with one of the names, best first, of which some end in '*'; -1 without.
int find_column_among(OGRLayer& layer, std::string_view names) {
  OGRFeatureDefn& columns = *layer.GetLayerDefn();
  while (!names.empty()) {
    const std::size_t comma = std::min(names.find(','), names.size());
    std::string wanted = to_lower(names.substr(0, comma));
    names.remove_prefix(std::min(comma + 1, names.size()));
    const bool is_start = wanted.ends_with('*');
    if (is_start) wanted.pop_back();
    for (int i = 0; i < columns.GetFieldCount(); ++i) {
      const std::string name = to_lower(city::decode_text(columns.GetFieldDefn(i)->GetNameRef()));
      if (is_start ? name.starts_with(wanted) : name == wanted) return i;
    }
  }
  return -1;
}

// Splits "SRID=4326;POINT(13.4 52.5)"; the number is 0 where the text is no such.
std::pair<int, std::string_view> split_srid(std::string_view text) {
  constexpr std::string_view start = "srid=";
  text = city::trim(text);
  if (to_lower(text.substr(0, start.size())) != start) return {0, {}};
  text.remove_prefix(start.size());
  int srid = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), srid);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc() || srid <= 0 || !rest.starts_with(';')) return {0, {}};
  return {srid, city::trim(rest.substr(1))};
}

// The head of a geometry in binary, written in hexadecimal digits: the order of bytes, the kind,
// and in PostGIS' form the number of the CRS, of which GDAL reads the places alone.
struct BinaryHead {
  std::uint32_t kind = 0;  // 1: a point; 0: the text is no such
  int srid = 0;            // 0: it names none
};

// PostgreSQL writes "\\x" before the digits of bytes, others "0x".
std::string_view skip_prefix_of_hex(std::string_view text) {
  text = city::trim(text);
  if (text.starts_with("\\x") || text.starts_with("0x") || text.starts_with("0X"))
    text.remove_prefix(2);
  return text;
}

BinaryHead read_binary_head(std::string_view text) {
  constexpr std::uint32_t has_srid = 0x20000000;
  constexpr std::size_t digits = 18;
  text = skip_prefix_of_hex(text);
  std::array<std::uint32_t, digits / 2> bytes{};
  if (text.size() < digits) return {};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char* const first = text.data() + 2 * i;
    const auto [end, error] = std::from_chars(first, first + 2, bytes[i], 16);
    if (error != std::errc() || end != first + 2) return {};
  }
  if (bytes[0] > 1) return {};
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= bytes[at + i] << (8 * (bytes[0] == 1 ? i : 3 - i));
    return value;
  };
  constexpr std::uint32_t most = 1'000'000, flags = 0xF0000000, of_iso = 1000;
  const std::uint32_t kind = (number(1) & ~flags) % of_iso;  // without marks of Z and M
  const bool names_crs = (number(1) & has_srid) != 0 && number(5) <= most;
  return {kind, names_crs ? static_cast<int>(number(5)) : 0};
}

// Returns a number without the sign of metres behind it.
std::string_view drop_metres(std::string_view number) {
  if (number.size() > 1 && number.ends_with('m'))
    number = city::trim(number.substr(0, number.size() - 1));
  return number;
}

// Returns a coordinate of a grid, whose digits may stand in groups.
std::optional<double> parse_grouped(std::string_view text) {
  constexpr double least_m = 1000;  // "391.403" are as many thousands
  const std::string plain = osm::to_plain_signs(city::trim(text));
  std::string_view rest = drop_metres(plain);
  const bool is_negative = rest.starts_with('-');
  if (is_negative) rest.remove_prefix(1);
  const auto size = osm::take_amount(rest, least_m);
  if (!size || !rest.empty()) return {};
  return is_negative ? -*size : *size;
}

// Returns whether more separates the digits of a number than a decimal point or comma, or GDAL does
// not take it for a number: it has a minus of typography, say, or a unit.
bool has_groups(std::string_view text) {
  const std::string plain = osm::to_plain_signs(city::trim(text));
  if (plain != city::trim(text) || drop_metres(plain).size() < plain.size()) return true;
  const auto separators =
      std::count_if(plain.begin(), plain.end(), [](char c) { return c == '.' || c == ','; });
  return separators > 1 || plain.find_first_of("' ") != std::string::npos;
}

// Returns whether a text is a geometry in WKT or EWKT, of points.
bool is_wkt_of_points(std::string_view text) {
  const std::string lower =
      to_lower(split_srid(text).first == 0 ? city::trim(text) : split_srid(text).second);
  for (const std::string_view kind : {"point", "multipoint"}) {
    if (!lower.starts_with(kind)) continue;
    const std::size_t next = lower.find_first_not_of(" zm", kind.size());
    if (next != std::string::npos && lower[next] == '(') return true;
  }
  return false;
}

bool is_geojson_of_points(std::string_view text) {
  return city::trim(text).starts_with('{') && text.find("\"coordinates\"") != text.npos &&
         (text.find("\"Point\"") != text.npos || text.find("\"MultiPoint\"") != text.npos);
}

// Returns whether a text is a point of KML.
bool is_kml_of_points(std::string_view text) {
  return city::trim(text).starts_with("<") && text.find("Point>") != text.npos &&
         text.find("<coordinates>") != text.npos;
}

bool is_geometry_of_points(std::string_view text) {
  constexpr std::uint32_t point = 1, multipoint = 4;
  constexpr std::size_t least_digits = 42;  // of a point in a plane
  const std::uint32_t kind = text.size() < least_digits ? 0 : read_binary_head(text).kind;
  return is_wkt_of_points(text) || is_geojson_of_points(text) || is_kml_of_points(text) ||
         kind == point || kind == multipoint;
}

// Reads what GDAL does not take out of a column: a feature of GeoJSON, digits behind a prefix.
OGRGeometryUniquePtr read_other_geometry(const std::string& text) {
  if (is_geojson_of_points(text)) {
    CPLJSONDocument document;
    if (!document.LoadMemory(text)) return {};
    const CPLJSONObject inner = document.GetRoot().GetObj("geometry");
    const std::string geometry =
        inner.IsValid() ? inner.Format(CPLJSONObject::PrettyFormat::Plain) : text;
    return OGRGeometryUniquePtr(OGRGeometryFactory::createFromGeoJson(geometry.c_str()));
  }
  // GML's points of its second version have the same form.
  if (is_kml_of_points(text))
    return OGRGeometryUniquePtr(OGRGeometryFactory::createFromGML(text.c_str()));
  const std::string_view digits = skip_prefix_of_hex(text);
  if (read_binary_head(digits).kind == 0) return {};
  int size = 0;
  GByte* const bytes = CPLHexToBinary(std::string(digits).c_str(), &size);
  OGRGeometry* made = nullptr;
  OGRGeometryFactory::createFromWkb(bytes, nullptr, &made, static_cast<std::size_t>(size));
  CPLFree(bytes);
  return OGRGeometryUniquePtr(made);
}

}  // namespace

TextPlaces::TextPlaces(OGRLayer& layer, const InventoryFile& inventory)
    : file_(inventory.file.string()), geometry_(find_column_among(layer, geometry_names)) {
  const CoordinateColumns guess = find_coordinate_columns(*layer.GetLayerDefn());
  x_ = inventory.x.empty() ? guess.x : find_column_among(layer, inventory.x);
  y_ = inventory.y.empty() ? guess.y : find_column_among(layer, inventory.y);
  // The first may have no place.
  constexpr int first_rows = 100;
  layer.ResetReading();
  for (int i = 0; i < first_rows; ++i) {
    const OGRFeatureUniquePtr row(layer.GetNextFeature());
    if (!row) break;
    look_at(*row);
  }
  layer.ResetReading();
}

void TextPlaces::look_at(const OGRFeature& row) {
  for (int i = 0; geometry_ < 0 && i < row.GetFieldCount(); ++i)
    if (row.GetFieldDefnRef(i)->GetType() == OFTString && is_geometry_of_points(text_of(row, i)))
      geometry_ = i;
  if (geometry_ >= 0 && crs_.empty()) {
    const std::string text = text_of(row, geometry_);
    const int srid = split_srid(text).first, binary = read_binary_head(text).srid;
    if (srid != 0 || binary != 0) crs_ = "EPSG:" + std::to_string(srid != 0 ? srid : binary);
    // RFC 7946; OGC 07-147
    if (is_geojson_of_points(text) || is_kml_of_points(text)) crs_ = "OGC:CRS84";
  }
  if (!has_columns()) return;
  for (const int column : {x_, y_}) {
    const std::string text(city::trim(text_of(row, column)));
    // "13 24 03,6" is an angle as "13:24:03,6" is, but "391 403,3" a number in groups.
    const bool is_plain = text.find_first_not_of("0123456789.,+-eE") == std::string::npos;
    begins_with_angles_ =
        begins_with_angles_ || (!is_plain && parse_angle(text) && !parse_grouped(text));
    begins_with_groups_ = begins_with_groups_ || (has_groups(text) && parse_grouped(text));
  }
}

OGRGeometryUniquePtr TextPlaces::read_geometry(const OGRFeature& row) const {
  if (geometry_ < 0) return {};
  const std::string text = text_of(row, geometry_);
  const auto [srid, geometry] = split_srid(text);
  if (srid == 0) return read_other_geometry(text);
  if (const std::string crs = "EPSG:" + std::to_string(srid); crs != crs_)
    throw Error(file_, "has geometries in several CRSs (" + crs_ + ", and " + crs + " in row " +
                           std::to_string(row.GetFID()) +
                           "): make a file for each, and a row of [[lamps.inventories]]");
  OGRGeometry* made = nullptr;
  OGRGeometryFactory::createFromWkt(std::string(geometry).c_str(), nullptr, &made);
  return OGRGeometryUniquePtr(made);
}

std::optional<glm::dvec2> TextPlaces::read_lon_lat(const OGRFeature& row) const {
  if (x_ < 0 || y_ < 0) return {};
  const auto x = parse_angle(text_of(row, x_)), y = parse_angle(text_of(row, y_));
  if (!x || !y || (x->axis == y->axis && x->axis != Angle::Axis::unknown)) return {};
  const bool turned = x->axis == Angle::Axis::latitude || y->axis == Angle::Axis::longitude;
  return turned ? glm::dvec2(y->degrees, x->degrees) : glm::dvec2(x->degrees, y->degrees);
}

std::optional<glm::dvec2> TextPlaces::read_grouped(const OGRFeature& row) const {
  if (x_ < 0 || y_ < 0 || begins_with_angles_) return {};
  const auto x = parse_grouped(text_of(row, x_)), y = parse_grouped(text_of(row, y_));
  return x && y ? std::optional(glm::dvec2(*x, *y)) : std::nullopt;
}

std::string TextPlaces::text_of(const OGRFeature& row, int column) const {
  return city::decode_text(row.GetFieldAsString(column));
}

}  // namespace nightcity::inventory
