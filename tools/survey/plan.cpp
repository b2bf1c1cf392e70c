#include "tools/survey/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "tools/survey/choose_place.h"
#include "tools/terrain/open_models.h"

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

  Plan::Files find(std::initializer_list<Use> uses, bool placed_alone = false) const {
    Plan::Files found;
    for (const SurveyedFile& file : files_)
      if (std::find(uses.begin(), uses.end(), file.use) != uses.end() &&
          (file.has_crs || !placed_alone))
        found.push_back(&file);
    return found;
  }

  // Takes the files of one place, and leaves the others out.
  void take_place(const Plan::Files& files, double near, std::initializer_list<Use> companions,
                  Plan::Files& taken) {
    const PlaceChoice choice =
        choose_place(files, near, find(companions, true),
                     [](const SurveyedFile& file, const Box& box) { return lies_at(file, box); });
    for (std::size_t n = 0; n < choice.places.size(); ++n) {
      if (n == choice.chosen) {
        taken = choice.places[n].files;
        plan_.box = choice.places[n].box;
        continue;
      }
      for (const SurveyedFile* file : choice.places[n].files)
        leave_out(*file, choice.reason + ": make a recipe of its own");
    }
  }

  void take_cities() {
    const Plan::Files all = find({Use::city}), placed = find({Use::city}, true);
    if (placed.empty()) plan_.cities = all;
    has_place_ = all.empty() || !placed.empty();
    if (placed.empty()) return;
    for (const SurveyedFile* file : all)
      if (!file->has_crs)
        leave_out(*file,
                  "names no CRS, unlike the other models: say it by [city] crs in a recipe "
                  "of its own");
    take_place(placed, near_degrees, {Use::map, Use::inventory, Use::elevation}, plan_.cities);
  }

  void take_maps() {
    Plan::Files maps;
    for (const SurveyedFile* file : find({Use::map})) {
      if (!has_place_)
        leave_out(*file, "cannot be laid under a model that names no CRS: say it by [city] crs");
      else if (file->box.empty())
        leave_out(*file, "holds neither lamps, streets nor buildings");
      else if (!plan_.box.empty() && !plan_.box.is_near(file->box, overlap_degrees))
        leave_out(*file, "covers another place than the model");
      else
        maps.push_back(file);
    }
    // Without a model the maps decide where the city lies.
    if (plan_.cities.empty())
      take_place(maps, overlap_degrees, {Use::inventory, Use::elevation}, plan_.maps);
    else
      plan_.maps = std::move(maps);
  }

  void take_rasters() {
    for (const SurveyedFile& file : files_) {
      if (file.use != Use::elevation) continue;
      if (file.has_crs && !has_place_)
        leave_out(file, "cannot be laid under a model that names no CRS: say it by [city] crs");
      else if (file.has_crs && !plan_.box.empty() && !lies_at(file, plan_.box))
        leave_out(file, "covers another place than the city");
      else
        plan_.rasters.push_back(&file);
    }
  }

  static bool lies_at(const SurveyedFile& file, const Box& box) {
    if (file.use != Use::elevation) return box.is_near(file.box, overlap_degrees);
    const glm::dvec2 size = box.greatest - box.least;
    std::vector<glm::dvec2> places;
    for (const double x : {0.1, 0.5, 0.9})
      for (const double y : {0.1, 0.5, 0.9}) places.push_back(box.least + size * glm::dvec2(x, y));
    std::vector<double> heights(places.size());
    const auto knows_one = [&](const terrain::ElevationModel& model) {
      model.sample(places, heights);
      return std::any_of(heights.begin(), heights.end(), [](double h) { return std::isfinite(h); });
    };
    const std::vector<terrain::ElevationModel> models =
        terrain::open_elevation_models({file.path}, {});
    return std::any_of(models.begin(), models.end(), knows_one);
  }

  void take_inventories() {
    for (const SurveyedFile& file : files_) {
      if (file.use != Use::inventory) continue;
      if (!has_place_)
        leave_out(file, "cannot be laid under a model that names no CRS: say it by [city] crs");
      else if (!plan_.box.empty() && !lies_at(file, plan_.box))
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
