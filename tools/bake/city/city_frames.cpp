#include "tools/bake/city/city_frames.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>

#include "formats/error.h"
#include "tools/inputs/read_city.h"

namespace nightcity {
namespace {

glm::dvec3 median_of(std::vector<glm::dvec3> points) {
  glm::dvec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    std::nth_element(
        points.begin(), middle, points.end(),
        [axis](const glm::dvec3& a, const glm::dvec3& b) { return a[axis] < b[axis]; });
    result[axis] = (*middle)[axis];
  }
  return result;
}

// Two control points: the corners of all the files' geometry at the corners of the bounds. Costs a reading.
std::vector<CityFrame::ControlPoint> corners_at(const std::array<double, 4>& bounds,
                                                const Recipe& recipe) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const auto& file : recipe.city.files)
    inputs::read_city(file, recipe.city.read, [&](CityObject&& object) {
      for (const Polygon& polygon : object.polygons)
        for (const glm::dvec3& p : polygon.exterior) {
          low = glm::min(low, glm::dvec2(p));
          high = glm::max(high, glm::dvec2(p));
        }
    });
  return {{{bounds[0], bounds[1]}, low}, {{bounds[2], bounds[3]}, high}};
}

}  // namespace

CityFrames::CityFrames(const Recipe& recipe) {
  if (recipe.city.files.empty())
    throw UsageError(recipe.path.string(), "names no city: [city] files = [\"...\"] is missing");
  std::vector<CityHead> heads;
  for (const auto& file : recipe.city.files) heads.push_back(inputs::read_city_head(file));
  const auto has_geometry = [](const CityHead& head) { return !head.sample.empty(); };
  const auto first = std::find_if(heads.begin(), heads.end(), has_geometry);
  if (first == heads.end())
    throw Error(recipe.city.files.front().string(), "no geometry in any file of the city");
  const auto add_place = [&](std::size_t file, auto&& make) {
    try {
      return make();
    } catch (const UsageError&) {
      throw;
    } catch (const Error& error) {
      throw Error(recipe.city.files[file].string(), error.what());
    }
  };

  CityFrame::Options options = recipe.city.frame;
  if (recipe.city.bounds) {
    options.control_points = corners_at(*recipe.city.bounds, recipe);
    if (options.crs_override.empty())
      options.crs_override = "none";  // the user knows better than the file
  }

  const auto first_index = static_cast<std::size_t>(first - heads.begin());
  city_ = add_place(first_index, [&] {
    return CityFrame::from_srs_name(first->srs_name, first->sample, options);
  });
  descriptions_.push_back(city_->description());
  std::vector<glm::dvec3> sample = first->sample;
  city_->to_projected(sample);
  reference_ = median_of(std::move(sample));

  // An override or control points speak for every file.
  const bool one_crs = !options.crs_override.empty() || !options.control_points.empty();
  foreign_of_file_.resize(heads.size());
  for (std::size_t i = 0; i < heads.size(); ++i) {
    if (one_crs || !has_geometry(heads[i]) || heads[i].srs_name == first->srs_name) continue;
    const auto known = std::find_if(foreign_.begin(), foreign_.end(), [&](const Foreign& f) {
      return f.srs_name == heads[i].srs_name;
    });
    foreign_of_file_[i] = static_cast<std::size_t>(known - foreign_.begin());
    if (known != foreign_.end()) continue;
    CityFrame frame = add_place(
        i, [&] { return CityFrame::from_srs_name(heads[i].srs_name, heads[i].sample, options); });
    const bool same_crs = frame.crs() == city_->crs();
    if (same_crs) {
      foreign_.push_back({heads[i].srs_name, std::move(frame), true});
      continue;
    }
    if (!frame.has_lon_lat() || !city_->has_lon_lat())
      throw Error(recipe.city.files[i].string(),
                  "has another CRS than the city's first file, and one of the two is unknown: set "
                  "[city] crs");
    descriptions_.push_back(frame.description());
    foreign_.push_back({heads[i].srs_name, std::move(frame), false});
  }
}

void CityFrames::to_city(std::size_t file, std::span<glm::dvec3> coordinates) const {
  const auto& foreign = foreign_of_file_.at(file);
  if (!foreign) return city_->to_projected(coordinates);
  const CityFrame& frame = foreign_[*foreign].frame;
  frame.to_projected(coordinates);
  if (foreign_[*foreign].same_crs) return;
  for (glm::dvec3& p : coordinates)
    p = glm::dvec3(city_->from_lon_lat(frame.to_lon_lat(glm::dvec2(p))), p.z);
}

}  // namespace nightcity
