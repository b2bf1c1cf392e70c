#include "tools/city/city_reader.h"

#include "tools/city/text_encoding.h"

#include <algorithm>
#include <utility>

namespace nightcity::city {
namespace {

void tell_flat_buildings(const std::filesystem::path& file, ReadReport& report) {
  if (report.extruded > 0)
    report.warnings.push_back(file.string() + ": " + std::to_string(report.extruded) +
                              " buildings have a footprint alone (LoD0): made blocks of their "
                              "measured height, their roof edge or their storeys");
  if (report.flat > 0)
    report.warnings.push_back(
        file.string() + ": " + std::to_string(report.flat) +
        " buildings have a footprint alone (LoD0) and neither a measured height nor "
        "storeys: they are flat");
}

// Heights in feet or centimetres under the name of a CRS in metres are so.
void tell_odd_heights(const std::filesystem::path& file, ReadReport& report) {
  constexpr std::size_t enough = 3;
  const std::size_t all = report.as_measured + report.above_measured + report.below_measured;
  const std::size_t odd = std::max(report.above_measured, report.below_measured);
  if (all < enough || 10 * odd < 9 * all) return;
  report.warnings.push_back(
      file.string() + ": " + std::to_string(odd) + " of " + std::to_string(all) +
      " buildings with a measured height are " +
      (report.above_measured == odd ? "more than 2.5 times as high"
                                    : "less than 0.4 times as high") +
      " in their shape: heights may be in another unit than their CRS says (feet, centimetres): "
      "name one with that unit in [city] crs, or convert the file");
}

void tell_pictures(const std::filesystem::path& file, ReadReport& report) {
  if (report.coloured_by_pictures == 0) return;
  std::string text = file.string() + ": " + std::to_string(report.coloured_by_pictures) +
                     " surfaces have the mean colour of their pictures";
  if (report.laid_out_pictures > 0)
    text += "; on " + std::to_string(report.laid_out_pictures) + " polygons they are laid out";
  report.warnings.push_back(std::move(text));
}

void make_texts_valid(ReadReport& report) {
  report.srs_name = to_valid_utf8(std::move(report.srs_name));
  for (std::string& warning : report.warnings) warning = to_valid_utf8(std::move(warning));
  std::map<std::string, std::size_t> skipped;
  for (const auto& [what, count] : report.skipped) skipped[to_valid_utf8(what)] += count;
  report.skipped = std::move(skipped);
}

}  // namespace

void finish_report(const std::filesystem::path& file, ReadReport& report) {
  tell_flat_buildings(file, report);
  tell_odd_heights(file, report);
  tell_pictures(file, report);
  make_texts_valid(report);
}

void ReadReport::merge(const ReadReport& other) {
  if (version.empty()) version = other.version;
  if (srs_name.empty()) srs_name = other.srs_name;
  objects += other.objects;
  polygons += other.polygons;
  extruded += other.extruded;
  flat += other.flat;
  as_measured += other.as_measured;
  above_measured += other.above_measured;
  below_measured += other.below_measured;
  coloured_by_pictures += other.coloured_by_pictures;
  laid_out_pictures += other.laid_out_pictures;
  if (needs_whole_file.empty()) needs_whole_file = other.needs_whole_file;
  for (const auto& [name, count] : other.skipped) skipped[name] += count;
  for (const auto& [name, count] : other.assumed) assumed[name] += count;
  for (const auto& [name, count] : other.passed_over) passed_over[name] += count;
  warnings.insert(warnings.end(), other.warnings.begin(), other.warnings.end());
}

ObjectStage deliver_to(const ObjectSink& sink) {
  return [&sink](std::vector<CityObject>&& objects) -> std::function<void()> {
    // std::function wants to copy what it holds.
    const auto held = std::make_shared<std::vector<CityObject>>(std::move(objects));
    return [&sink, held] {
      for (CityObject& object : *held) sink(std::move(object));
    };
  };
}

}  // namespace nightcity::city
