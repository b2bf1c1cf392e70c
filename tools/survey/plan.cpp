#include "tools/survey/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/terrain/elevation_model.h"

namespace nightcity::survey {
namespace {

// A city model's box is that of its beginning, so what lies a little beyond may belong to it.
constexpr double near_degrees = 0.5;      // of tiles of one model: 50 km
constexpr double overlap_degrees = 0.05;  // of maps and inventories: 5 km

class Planner {
 public:
  explicit Planner(const std::vector<SurveyedFile>& files) : files_(files) {}

  Plan make() {
    take_cities();
    take_maps();
    take_rasters();
    take_inventories();
    for (const SurveyedFile& file : files_)
      if (file.use == Use::luminaire) plan_.luminaires.push_back(&file);
    tell_missing();
    return std::move(plan_);
  }

 private:
  void leave_out(const SurveyedFile& file, std::string why) {
    plan_.left_out.emplace_back(&file, std::move(why));
  }

  void take_cities() {
    const bool any_placed = std::any_of(files_.begin(), files_.end(), [](const SurveyedFile& f) {
      return f.use == Use::city && f.has_crs;
    });
    for (const SurveyedFile& file : files_) {
      if (file.use != Use::city) continue;
      if (any_placed && !file.has_crs) {
        leave_out(file,
                  "names no CRS, unlike the other models: say it by [city] crs in a recipe "
                  "of its own");
      } else if (any_placed && !plan_.box.empty() && !plan_.box.is_near(file.box, near_degrees)) {
        leave_out(file, "lies elsewhere: make a recipe of its own");
      } else {
        plan_.cities.push_back(&file);
        if (!file.box.empty()) {
          plan_.box.add(file.box.least);
          plan_.box.add(file.box.greatest);
        }
      }
    }
    has_place_ = plan_.cities.empty() || any_placed;
  }

  void take_maps() {
    for (const SurveyedFile& file : files_) {
      if (file.use != Use::map) continue;
      if (!has_place_)
        leave_out(file, "cannot be laid under a model that names no CRS: say it by [city] crs");
      else if (file.box.empty())
        leave_out(file, "holds neither lamps, streets nor buildings");
      else if (!plan_.box.empty() && !plan_.box.is_near(file.box, overlap_degrees))
        leave_out(file, plan_.cities.empty() ? "covers another place than the first map"
                                             : "covers another place than the model");
      else
        add_map(file);
    }
  }

  // Without a model the first map decides where the city lies.
  void add_map(const SurveyedFile& file) {
    plan_.maps.push_back(&file);
    if (!plan_.cities.empty() || file.box.empty()) return;
    plan_.box.add(file.box.least);
    plan_.box.add(file.box.greatest);
  }

  void take_rasters() {
    for (const SurveyedFile& file : files_) {
      if (file.use != Use::elevation) continue;
      if (file.has_crs && !has_place_)
        leave_out(file, "cannot be laid under a model that names no CRS: say it by [city] crs");
      else if (file.has_crs && !plan_.box.empty() && !covers_city(file))
        leave_out(file, "covers another place than the city");
      else
        plan_.rasters.push_back(&file);
    }
  }

  bool covers_city(const SurveyedFile& file) const {
    const terrain::ElevationModel model(file.path);
    const glm::dvec2 size = plan_.box.greatest - plan_.box.least;
    std::vector<glm::dvec2> places;
    for (const double x : {0.1, 0.5, 0.9})
      for (const double y : {0.1, 0.5, 0.9})
        places.push_back(plan_.box.least + size * glm::dvec2(x, y));
    std::vector<double> heights(places.size());
    model.sample(places, heights);
    return std::any_of(heights.begin(), heights.end(), [](double h) { return std::isfinite(h); });
  }

  void take_inventories() {
    for (const SurveyedFile& file : files_) {
      if (file.use != Use::inventory) continue;
      if (!has_place_)
        leave_out(file, "cannot be laid under a model that names no CRS: say it by [city] crs");
      else if (!plan_.box.empty() && !plan_.box.is_near(file.box, overlap_degrees))
        leave_out(file, "covers another place than the city");
      else
        plan_.inventories.push_back(&file);
    }
  }

  void tell_missing() {
    const auto has = [](const Plan::Files& files, bool SurveyedFile::*what) {
      return std::any_of(files.begin(), files.end(),
                         [&](const SurveyedFile* f) { return f->*what; });
    };
    if (!has_place_)
      plan_.missing.push_back(
          "the model's CRS: ask its publisher, and say it by [city] crs; without it there are "
          "neither lamps nor streets");
    if (plan_.cities.empty() && !plan_.maps.empty())
      plan_.missing.push_back(
          "a city model (CityGML, CityJSON): without one the map's buildings are the model");
    tell_missing_lamps(has(plan_.cities, &SurveyedFile::has_roads));
    if (plan_.rasters.empty() && !has(plan_.cities, &SurveyedFile::has_relief))
      plan_.missing.push_back(
          plan_.cities.empty()
              ? "an elevation model (GeoTIFF): without one the buildings stand on a plane"
              : "an elevation model (GeoTIFF) or a relief: without one the ground is a surface "
                "through the buildings' footprints");
  }

  void tell_missing_lamps(bool has_roads) {
    std::size_t lamps = 0, streets = 0;
    for (const SurveyedFile* map : plan_.maps) lamps += map->lamps, streets += map->streets;
    if (!plan_.inventories.empty() || lamps > 0) return;
    if (streets > 0) {
      plan_.missing.push_back("mapped lamps: they are laid out along the map's lit streets");
    } else if (has_place_) {
      std::string where =
          has_roads ? "lamps are laid out along the model's own roads" : "no lamp will shine";
      plan_.missing.push_back("a map of streets and lamps: without one " + where +
                              (plan_.box.empty() ? "" : ". " + where_to_fetch()));
    }
  }

  std::string where_to_fetch() const {
    const double west = plan_.box.least.x - margin, east = plan_.box.greatest.x + margin;
    std::string addresses = to_address(std::max(west, -180.0), std::min(east, 180.0), "map.osm");
    // A request ends at the antimeridian.
    if (east > 180) addresses += " and " + to_address(-180, east - 360, "map_east.osm");
    if (west < -180) addresses += " and " + to_address(west + 360, 180, "map_west.osm");
    return "OpenStreetMap has it: " + addresses +
           "; for more than a few km an extract of https://download.geofabrik.de";
  }

  std::string to_address(double west, double east, const char* file) const {
    return fmt::format(
        "curl -o {} 'https://overpass-api.de/api/map?bbox={:.4f},{:.4f},{:.4f},{:.4f}'", file, west,
        plan_.box.least.y - margin, east, plan_.box.greatest.y + margin);
  }

  static constexpr double margin = 0.005;  // degrees, 500 m
  const std::vector<SurveyedFile>& files_;
  Plan plan_;
  bool has_place_ = true;  // places of the earth can be laid under the model
};

}  // namespace

Plan make_plan(const std::vector<SurveyedFile>& files) {
  return Planner(files).make();
}

}  // namespace nightcity::survey
