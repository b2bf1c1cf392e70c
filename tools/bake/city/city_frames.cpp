#include "tools/bake/city/city_frames.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <set>
#include <utility>

#include "formats/error.h"
#include "formats/median.h"
#include "tools/inputs/file_format.h"
#include "tools/inputs/read_city.h"

namespace nightcity::bake {
namespace {

glm::dvec3 find_median(const std::vector<glm::dvec3>& points) {
  glm::dvec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const glm::dvec3& p : points) values.push_back(p[axis]);
    result[axis] = median(std::move(values));
  }
  return result;
}

bool has_geometry(const city::CityHead& head) {
  return !head.sample.empty();
}

// Returns "; geometry is linked from lib.gml, which is not in [city] files", or "" where no file
// has such a link: the rest of a message that the city has no geometry.
std::string describe_missing_links(const std::vector<std::filesystem::path>& files,
                                   const std::vector<city::CityHead>& heads) {
  std::set<std::filesystem::path> listed;
  for (const auto& file : files) listed.insert(file.lexically_normal());
  std::set<std::string> absent, not_listed;
  for (std::size_t i = 0; i < heads.size(); ++i)
    for (const std::string& link : heads[i].linked_files) {
      if (link.find("://") != std::string::npos) {
        absent.insert(link);
        continue;
      }
      const std::filesystem::path target = (files[i].parent_path() / link).lexically_normal();
      if (listed.contains(target)) continue;
      std::error_code unknown;
      (std::filesystem::exists(target, unknown) ? not_listed : absent).insert(target.string());
    }
  std::string text;
  for (const std::string& file : not_listed)
    text += "; geometry is linked from " + file + ", which is not listed: add it to [city] files";
  for (const std::string& file : absent)
    text += "; geometry is linked from " + file +
            ", which is not there: fetch it and add it to [city] files";
  return text;
}

// Returns two control points: the corners of all the files' geometry at the corners of the bounds.
std::vector<georeference::CityFrame::ControlPoint> corners_at(const std::array<double, 4>& bounds,
                                                              const PlanExtent& extent) {
  return {{{bounds[0], bounds[1]}, extent.low}, {{bounds[2], bounds[3]}, extent.high}};
}

// A map named by mistake among city models would put its buildings on a plane beside theirs. Where
// all files are the city's maps, their buildings are meant.
void refuse_maps_among_models(const CityInputs& inputs) {
  const auto is_model = [&](const std::filesystem::path& file) {
    return std::find(inputs.maps.begin(), inputs.maps.end(), file) == inputs.maps.end();
  };
  if (std::none_of(inputs.files.begin(), inputs.files.end(), is_model)) return;
  for (const auto& file : inputs.files)
    if (inputs::find_format(file).kind == inputs::FileKind::osm)
      throw Error(file.string(),
                  "is a map (OSM) and no city model: name it in [osm] files; its buildings are the "
                  "model where [city] files are absent");
}

georeference::CityFrame make_frame(const std::string& where, const std::string& srs_name,
                                   std::span<const glm::dvec3> sample,
                                   const georeference::CityFrame::Options& options) {
  try {
    return georeference::CityFrame::from_srs_name(srs_name, sample, options);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw Error(where, error.what());
  }
}

}  // namespace

CityFrames::CityFrames(const CityInputs& inputs) {
  if (inputs.files.empty())
    throw UsageError(inputs.name(), "names no city: [city] files = [\"...\"] is missing");
  const std::vector<city::CityHead> heads = read_heads(inputs);
  const auto first = std::find_if(heads.begin(), heads.end(), has_geometry);
  if (first == heads.end())
    throw Error(inputs.files.front().string(), "no geometry in any file of the city" +
                                                   describe_missing_links(inputs.files, heads));

  georeference::CityFrame::Options options = inputs.frame;
  if (inputs.bounds) {
    options.control_points =
        corners_at(*inputs.bounds, inputs.survey && inputs.survey->extent ? *inputs.survey->extent
                                                                          : find_extent(inputs));
    if (options.crs_override.empty())
      options.crs_override = "none";  // bounds are given because the file's CRS is missing or wrong
  }
  const auto number = static_cast<std::size_t>(first - heads.begin());
  city_ = make_frame(inputs.files[number].string(), first->srs_name, first->sample, options);
  descriptions_.push_back(city_->description());
  warn(inputs.files[number].string(), *city_);
  std::vector<glm::dvec3> sample = first->sample;
  city_->to_projected(sample);
  reference_ = find_median(sample);

  first_name_ = first->srs_name;
  foreign_of_file_.resize(heads.size());
  // An override or control points apply to every file.
  if (options.crs_override.empty() && options.control_points.empty())
    add_foreign(inputs, heads, number, options);
}

std::vector<city::CityHead> CityFrames::read_heads(const CityInputs& inputs) {
  if (inputs.survey) return inputs.survey->heads;
  refuse_maps_among_models(inputs);
  std::vector<city::CityHead> heads;
  for (const auto& file : inputs.files) heads.push_back(inputs::read_city_head(file, inputs.read));
  return heads;
}

void CityFrames::warn(const std::string& where, const georeference::CityFrame& frame) {
  if (!frame.axis_warning().empty()) warnings_.push_back(where + ": " + frame.axis_warning());
}

void CityFrames::add_foreign(const CityInputs& inputs, const std::vector<city::CityHead>& heads,
                             std::size_t first, const georeference::CityFrame::Options& options) {
  for (std::size_t i = 0; i < heads.size(); ++i) {
    names_.push_back(has_geometry(heads[i]) ? heads[i].srs_name : heads[first].srs_name);
    if (names_[i] == first_name_) continue;
    foreign_of_file_[i] = find_foreign(names_[i]);
    if (foreign_of_file_[i]) continue;
    foreign_.push_back(make_foreign(names_[i], heads[i].sample, inputs.files[i].string(), options));
    foreign_of_file_[i] = &foreign_.back();
  }
}

CityFrames::Foreign CityFrames::make_foreign(const std::string& srs_name,
                                             std::span<const glm::dvec3> sample,
                                             const std::string& where,
                                             const georeference::CityFrame::Options& options) {
  georeference::CityFrame frame = make_frame(where, srs_name, sample, options);
  warn(where, frame);
  const bool same_crs = frame.crs() == city_->crs();
  if (!same_crs) {
    if (!frame.has_lon_lat() || !city_->has_lon_lat())
      throw Error(where,
                  "has another CRS than the city's first file, and one of the two is unknown: "
                  "set [city] crs");
    descriptions_.push_back(frame.description());
  }
  return {srs_name, std::move(frame), same_crs};
}

const CityFrames::Foreign* CityFrames::find_foreign(const std::string& srs_name) const {
  for (const Foreign& foreign : foreign_)
    if (foreign.srs_name == srs_name) return &foreign;
  return nullptr;
}

std::optional<std::string> CityFrames::srs_name_of(std::size_t file) const {
  return names_.empty() ? std::nullopt : std::optional(names_.at(file));
}

double CityFrames::height_unit_of(std::size_t file) const {
  const Foreign* foreign = foreign_of_file_.at(file);
  return foreign ? foreign->frame.height_unit_m() : city_->height_unit_m();
}

bool CityFrames::knows(const std::string& srs_name) const {
  const std::shared_lock lock(mutex_);
  return srs_name == first_name_ || find_foreign(srs_name);
}

void CityFrames::learn(const std::string& srs_name, std::span<const glm::dvec3> sample,
                       const std::string& where) {
  if (knows(srs_name)) return;
  Foreign foreign = make_foreign(srs_name, sample, where, {});
  const std::unique_lock lock(mutex_);
  foreign_.push_back(std::move(foreign));
}

void CityFrames::to_city(std::size_t file, std::span<glm::dvec3> coordinates,
                         const std::optional<glm::dvec3>& anchor) const {
  to_city(foreign_of_file_.at(file), coordinates, anchor);
}

void CityFrames::to_city(const std::string& srs_name, std::span<glm::dvec3> coordinates,
                         const std::optional<glm::dvec3>& anchor) const {
  const Foreign* foreign = nullptr;
  {
    const std::shared_lock lock(mutex_);
    foreign = find_foreign(srs_name);
  }
  to_city(foreign, coordinates, anchor);
}

void CityFrames::to_city(const Foreign* foreign, std::span<glm::dvec3> coordinates,
                         const std::optional<glm::dvec3>& anchor) const {
  if (!foreign) return city_->to_projected(coordinates, anchor);
  foreign->frame.to_projected(coordinates, anchor);
  if (foreign->same_crs) return;
  for (glm::dvec3& p : coordinates)
    p = glm::dvec3(city_->from_lon_lat(foreign->frame.to_lon_lat(glm::dvec2(p))), p.z);
}

}  // namespace nightcity::bake
