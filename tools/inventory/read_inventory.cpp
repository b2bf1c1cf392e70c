#include "tools/inventory/read_inventory.h"

#include <cpl_error.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "tools/city/attributes.h"
#include "tools/city/text_encoding.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/inventory/coordinate_columns.h"
#include "tools/inventory/degrees_text.h"
#include "tools/inventory/layer_columns.h"
#include "tools/inventory/layer_crs.h"
#include "tools/inventory/row_places.h"
#include "tools/inventory/server_limit.h"
#include "tools/inventory/text_places.h"
#include "tools/inventory/vector_file.h"
#include "tools/osm/tag_values.h"
#include "tools/place/longitude.h"
#include "tools/random.h"

namespace nightcity::inventory {
namespace {

// Returns the same number for the same row after every bake, and none that OpenStreetMap has: its
// ids lie far below 2^62.
std::int64_t make_id(const std::string& file, const std::string& row) {
  std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
  for (const std::string* text : {&file, &row})
    for (const char c : *text + '\n')
      hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return static_cast<std::int64_t>((mix(hash) >> 2) | std::uint64_t{1} << 62);
}

class Reader {
 public:
  explicit Reader(const InventoryFile& file)
      : file_(file),
        table_(open_vector_file(file)),
        layer_(find_layer(*table_.dataset, file)),
        columns_(layer_, file),
        zone_column_(find_zone_column(layer_)),
        point_column_(file.x.empty() ? find_point_column(layer_) : -1),
        texts_(layer_, file),
        crs_((require_geometry(), layer_), file_, find_crs_of_form()) {}

  Inventory read() {
    const gdal::Guard guard;
    CPLErrorReset();
    result_.report.file = file_.file.filename().string();
    result_.report.format = table_.format;
    result_.report.titles = table_.titles;
    result_.report.encoding = table_.encoding;
    result_.report.doubt = crs_.doubt();
    layer_.ResetReading();
    for (OGRFeatureUniquePtr row; (row = OGRFeatureUniquePtr(layer_.GetNextFeature()));) {
      if (++result_.report.rows > most_lamps()) refuse_more("rows");
      take(*row);
    }
    if (CPLGetLastErrorType() == CE_Failure)
      throw Error(file_.file.string(), "is broken behind row " +
                                           std::to_string(result_.report.rows) + ": " +
                                           gdal::find_reason());
    finish();
    return std::move(result_);
  }

 private:
  const std::string& find_crs_of_form() const {
    return table_.crs.empty() ? texts_.crs() : table_.crs;
  }

  std::size_t most_lamps() const { return static_cast<std::size_t>(file_.max_lamps); }

  [[noreturn]] void refuse_more(const char* things) const {
    throw Error(file_.file.string(), std::string("has more ") + things +
                                         " than max_lamps in [[lamps.inventories]] = " +
                                         std::to_string(file_.max_lamps));
  }

  void require_geometry() const {
    if (layer_.GetGeomType() != wkbNone || point_column_ >= 0 || texts_.has_columns()) return;
    throw Error(file_.file.string(),
                "has no geometry and no columns with coordinates: name them by x and y in "
                "[[lamps.inventories]]; its columns are " +
                    list_columns(layer_));
  }

  static constexpr const char* outside_crs = "with coordinates that its CRS does not have";

  void skip(const char* why) { ++result_.report.skipped[why]; }

  using Places = std::vector<glm::dvec2>;

  // The table has a column of UTM's zones, and one CRS for all.
  void look_at_zone(const OGRFeature& row) {
    if (zone_column_ < 0 || crs_.utm_zone() == 0) return;
    const auto zone = read_utm_zone(row, zone_column_);
    if (!zone || *zone == crs_.utm_zone()) return;
    if (other_zones_++ == 0) other_zone_ = row.GetFieldAsString(zone_column_);
  }

  void take(const OGRFeature& row) {
    Places places;
    look_at_zone(row);
    if (point_column_ >= 0 && !texts_.has_columns()) {
      const auto place = read_point(row);
      if (!place) return skip("without a place");
      places.push_back(*place);
    } else {
      const OGRGeometry* geometry = row.GetGeometryRef();
      const OGRGeometryUniquePtr as_text = geometry ? nullptr : texts_.read_geometry(row);
      // GDAL complains of a text that it does not understand, and goes on to the next row.
      if (!geometry) CPLErrorReset();
      if (!geometry) geometry = as_text.get();
      if (geometry && !geometry->IsEmpty()) {
        places = find_places(geometry);
        if (places.empty()) return skip("whose geometry is no point");
      } else {
        const auto grouped = crs_.is_geographic() ? std::nullopt : texts_.read_grouped(row);
        const auto lon_lat = grouped ? grouped : texts_.read_lon_lat(row);
        if (!lon_lat) return skip("without a place");
        if (!crs_.is_geographic() && !grouped)
          return skip("with degrees, where the CRS counts metres");
        places.push_back(*lon_lat);
      }
    }
    const osm::OsmTags tags = columns_.read(row);
    const std::string id = columns_.read_id(row);
    for (std::size_t i = 0; i < places.size(); ++i)
      add(places[i], tags, i == 0 ? id : id + "/" + std::to_string(i));
  }

  // Two numbers in brackets are a list, as JSON writes positions.
  std::optional<glm::dvec2> read_point(const OGRFeature& row) {
    const std::string text = city::decode_text(row.GetFieldAsString(point_column_));
    auto place = parse_lat_lon(text);
    const char* const name = row.GetFieldDefnRef(point_column_)->GetNameRef();
    constexpr double most_degrees = 90;
    if (!place || !city::trim(text).starts_with('[') || puts_latitude_first(name) ||
        std::abs(place->x) > most_degrees)
      return place;
    std::swap(place->x, place->y);
    if (result_.report.doubt.empty() && std::abs(place->x) <= most_degrees)
      result_.report.doubt = "its lists of two numbers (" + std::string(name) +
                             ") are read as longitude and latitude: where latitude is first, "
                             "name the column geo_point_2d";
    return place;
  }

  // Maps of the web that repeat sideways give longitudes that are a turn or more too large.
  glm::dvec2 turn_back(glm::dvec2 place) const {
    constexpr double turn = 360, most = 3 * turn;
    const bool is_beyond = place.x < -turn / 2 || place.x > turn;
    if (crs_.is_geographic() && is_beyond && std::abs(place.x) <= most)
      place.x = place::count_on(place.x, 0);
    return place;
  }

  void add(const glm::dvec2& given, const osm::OsmTags& tags, const std::string& id) {
    if (is_unfilled(given)) return skip("at 0, 0, as programs write that know no place");
    const glm::dvec2 place = turn_back(given);
    glm::dvec2 lon_lat = crs_.to_lon_lat(place);
    if (!(std::abs(lon_lat.x) <= 360 && std::abs(lon_lat.y) <= 90)) return skip(outside_crs);
    lon_lat.x = place::count_on(lon_lat.x, 0);
    const auto [found, is_new] = at_place_.try_emplace({place.x, place.y}, result_.lamps.size());
    if (is_new) {
      // One row may have any number of points.
      if (result_.lamps.size() >= most_lamps()) refuse_more("lamps");
      osm::OsmLampNode& lamp = result_.lamps.emplace_back();
      lamp.id = make_id(result_.report.file, id);
      lamp.lon_lat = lon_lat;
      lamp.tags = tags;
      lamp.is_inventory = true;
      return;
    }
    ++result_.report.joined;
    joined_[found->second].push_back(tags);
  }

  // Makes one post of rows at one place.
  void finish() {
    if (other_zones_ > 0 && result_.report.doubt.empty())
      result_.report.doubt = std::to_string(other_zones_) +
                             " of its rows name another zone of UTM (" + other_zone_ +
                             ") than its CRS has (" + std::to_string(crs_.utm_zone()) +
                             "): make a file for each zone, and a row of [[lamps.inventories]]";
    result_.report.incomplete = table_.incomplete.empty()
                                    ? find_server_limit(table_.path, result_.report.rows)
                                    : table_.incomplete;
    // Socrata sends as many, and says nothing of the others.
    constexpr std::size_t usual_page = 1000;
    if (result_.report.incomplete.empty() && result_.report.rows == usual_page)
      result_.report.incomplete =
          "perhaps: it has exactly 1000 rows, as many as some servers send where no limit is asked "
          "for ($limit): look whether there are others";
    for (const auto& [number, others] : joined_) {
      osm::OsmTags& tags = result_.lamps[number].tags;
      double count = number_of(tags, "light:count").value_or(1);
      for (const osm::OsmTags& other : others) count += number_of(other, "light:count").value_or(1);
      tags["light:count"] = std::to_string(static_cast<int>(std::clamp(count, 1.0, 12.0)));
      join(tags, others, "light:lumens", osm::parse_lumens);
      join(tags, others, "light:power", osm::parse_watts);
      tags.erase("light:direction");  // they look to several sides
    }
    if (columns_.takes_windows_1252()) result_.report.encoding = "Windows-1252";
    result_.report.lamps = result_.lamps.size();
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (columns_.used()[i] > 0)
        result_.report.columns[std::string(properties[i].name)] = columns_.used()[i];
    if (!result_.lamps.empty()) return;
    if (result_.report.rows == 0) throw Error(file_.file.string(), "has no row");
    if (!result_.report.skipped.contains(outside_crs))
      throw Error(file_.file.string(), "has no lamp: it has rows " +
                                           result_.report.skipped.begin()->first +
                                           "; a table of lamps has a point in each row");
    throw OutsideCrs(
        file_.file.string(),
        "has no row with a point in its CRS: say the CRS by crs in [[lamps.inventories]] "
        "where it is not the one that the file names");
  }

  static std::optional<double> number_of(const osm::OsmTags& tags, const char* key) {
    std::string_view text = osm::find_raw_tag(tags, key);
    return osm::take_number(text);
  }

  // Gives them the mean of what `parse` reads, where it reads all.
  template <class Parse>
  static void join(osm::OsmTags& tags, const std::vector<osm::OsmTags>& others, const char* key,
                   Parse parse) {
    const auto read = [&](const osm::OsmTags& from) -> std::optional<double> {
      const auto found = from.find(key);
      return found == from.end() ? std::nullopt : parse(found->second);
    };
    std::optional<double> sum = read(tags);
    for (const osm::OsmTags& other : others) {
      const auto value = read(other);
      if (!sum || !value) return;
      *sum += *value;
    }
    if (sum) tags[key] = std::to_string(*sum / static_cast<double>(others.size() + 1));
  }

  const InventoryFile& file_;
  VectorFile table_;
  OGRLayer& layer_;
  LayerColumns columns_;
  int zone_column_;   // of UTM; -1 without
  int point_column_;  // -1: the layer has geometries
  TextPlaces texts_;
  LayerCrs crs_;
  Inventory result_;
  std::size_t other_zones_ = 0;  // rows
  std::string other_zone_;
  std::map<std::pair<double, double>, std::size_t> at_place_;  // number of the lamp there
  std::map<std::size_t, std::vector<osm::OsmTags>> joined_;    // further rows of a lamp
};

}  // namespace

Inventory read_inventory(const InventoryFile& file) {
  const gdal::Guard guard;
  return Reader(file).read();
}

}  // namespace nightcity::inventory
