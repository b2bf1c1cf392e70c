#include "runtime/nightview/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/json_parse.h"
#include "formats/night.h"
#include "formats/program/child_program.h"
#include "formats/small_file.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/png.h"
#include "runtime/render/parse.h"
#include "runtime/render/setting_table.h"
#include "runtime/viewer/film_pictures.h"

namespace nightcity::nightview {
namespace {

namespace fs = std::filesystem;

// Returns the values by which two recordings are the same one.
nlohmann::json describe(const RecordingOptions& options, const render::Renderer& renderer,
                        const scene::CameraPath& path, const render::RenderSettings& settings) {
  const render::EnvironmentSettings& sky = settings.environment;
  nlohmann::json poses, values;
  for (const double u : {0.0, 0.37, 0.74, 1.0}) poses.push_back(scene::to_text(path.at(u)));
  for (const render::Setting& setting : render::list_settings())
    values[setting.name] = render::text_of(setting, settings);
  nlohmann::json description{
      {"scene", options.scene},
      {"path", options.path},
      {"poses", poses},
      {"moon", {sky.moon_direction.x, sky.moon_direction.y, sky.moon_direction.z, sky.moon_lux.g}},
      {"pictures", count_pictures(options)},
      {"pictures_per_s", options.pictures_per_s},
      {"clock_speed", options.clock_speed},
      {"frames", options.frames},
      {"exr", options.exr},
      {"time_s", settings.time_s},
      {"width", renderer.picture_size().x},
      {"height", renderer.picture_size().y},
      {"settings", values}};
  if (settings.environment.lights != scene::all_families)
    description["lights"] = scene::text_of(settings.environment.lights);
  if (settings.projection != PROJECTION_PERSPECTIVE)
    description["projection"] = settings.projection;
  return description;
}

// Metered from the first picture, so that all pictures are shown alike.
struct Metered {
  std::optional<float> ev100;
  std::optional<glm::vec3> light;  // measure::mean_light
};

// Returns what an earlier run of the same recording metered. Throws Error where the folder holds
// another one.
Metered find_earlier(const fs::path& file, const nlohmann::json& wanted) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return {};
  const auto found = try_parse_json(read_small_file(file));
  if (!found.is_object() || !found.contains("recording") || found["recording"] != wanted)
    throw Error(file.string(),
                "this folder holds another recording, or one with other options: remove it, or "
                "name another folder");
  Metered metered;
  if (found.contains("ev100") && found["ev100"].is_number())
    metered.ev100 = found["ev100"].get<float>();
  const nlohmann::json light = found.value("light_cd_m2", nlohmann::json());
  if (light.is_array() && light.size() == 3 &&
      std::all_of(light.begin(), light.end(), [](const auto& part) { return part.is_number(); }))
    metered.light = glm::vec3(light[0], light[1], light[2]);
  return metered;
}

void write_description(const fs::path& file, const nlohmann::json& recording,
                       const Metered& metered) {
  nlohmann::json document{{"recording", recording}};
  if (metered.ev100) document["ev100"] = *metered.ev100;
  if (metered.light)
    document["light_cd_m2"] = {metered.light->r, metered.light->g, metered.light->b};
  AtomicFile out(file);
  out.write(document.dump(2) + "\n");
  out.commit();
}

// Meters a picture for what is not known yet. Returns whether anything was not.
bool meter(const render::Renderer& renderer, bool needs_light, Metered& metered) {
  if (metered.ev100 && (metered.light || !needs_light)) return false;
  const measure::Image sample =
      renderer.sample_mean(std::size_t{renderer.width()} * renderer.height());
  if (!metered.ev100) metered.ev100 = measure::auto_exposure_ev100(sample);
  if (needs_light && !metered.light) metered.light = measure::mean_light(sample);
  return true;
}

void write_picture(const RecordingOptions& options, std::uint32_t number,
                   const measure::Image& image, const measure::Image8& shown) {
  // The PNG comes last: where it is, the picture is whole.
  if (options.exr)
    measure::write_exr(options.folder / viewer::name_of_picture(number, ".exr"), image);
  measure::write_png(options.folder / viewer::name_of_picture(number, ".png"), shown,
                     measure::png_text(image.info));
}

}  // namespace

std::uint32_t count_pictures(const RecordingOptions& options) {
  return viewer::count_pictures(options.duration_s, options.pictures_per_s);
}

std::uint32_t record(const RecordingOptions& options, render::Renderer& renderer,
                     const scene::RenderScene& scene, const scene::CameraPath& path,
                     render::RenderSettings settings,
                     const std::function<void(std::uint32_t)>& progress) {
  const nlohmann::json description = describe(options, renderer, path, settings);
  const fs::path file = options.folder / "record.json";
  Metered metered = find_earlier(file, description);
  if (options.ev100) metered.ev100 = options.ev100;
  write_description(file, description, metered);
  const std::uint32_t pictures = count_pictures(options), seed = settings.sampling.seed;
  const double begin_s = settings.time_s;
  settings.sampling.layers = options.exr && !render::is_half_rate(settings);
  std::uint32_t rendered = 0;
  for (std::uint32_t i = 0; i < pictures; ++i) {
    if (!fs::exists(options.folder / viewer::name_of_picture(i, ".png"))) {
      settings.time_s =
          std::min(begin_s + i / options.pictures_per_s * options.clock_speed, double(night_end_s));
      settings.sampling.seed = seed + i;  // other settings: nothing of the picture before is reused
      const scene::CameraPose pose = path.at(pictures > 1 ? double(i) / (pictures - 1) : 0);
      for (std::uint32_t k = 0; k < options.frames; ++k) renderer.render_frame(pose, settings);
      measure::Image image = renderer.download(options.exr);
      if (meter(renderer, settings.display.adapt_white, metered))
        write_description(file, description, metered);
      settings.display.ev100 = *metered.ev100;
      settings.display.adapted_to = metered.light.value_or(glm::vec3(0));
      image.info.ev100 = metered.ev100;
      image.info.eye = render::describe_eye(settings.display);
      image.info.licences = scene::describe_licences(scene);
      image.info.camera = scene::to_text(pose);
      image.info.time = render::time_text(settings.time_s);
      write_picture(options, i, image, renderer.develop(image, settings.display));
      ++rendered;
    }
    progress(i + 1);
  }
  return rendered;
}

namespace {

// Returns ffmpeg's name for the pictures of a folder: a pattern, in which a percent sign stands for
// a number and two for one. Absolute, because ffmpeg takes "a:b" for a protocol.
std::string pattern_of_pictures(const fs::path& folder) {
  std::string text;
  for (const char c : fs::absolute(folder).string()) text.append(c == '%' ? 2 : 1, c);
  return text + "/frame-%05d.png";
}

}  // namespace

bool make_film(const RecordingOptions& options, const fs::path& film) {
  // ffmpeg writes under another name first, so that the film's name never holds half of one.
  AtomicPath target(film);
  const std::string rate = fmt::format("{}", options.pictures_per_s);
  // Sides of H.264 in 4:2:0 are even.
  const auto ended = program::run_child({"ffmpeg",
                                         "-y",
                                         "-loglevel",
                                         "error",
                                         "-nostdin",
                                         "-framerate",
                                         rate,
                                         "-i",
                                         pattern_of_pictures(options.folder),
                                         "-vf",
                                         "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                         "-c:v",
                                         "libx264",
                                         "-pix_fmt",
                                         "yuv420p",
                                         "-crf",
                                         "16",
                                         "-f",
                                         "mp4",
                                         fs::absolute(target.scratch()).string()},
                                        false);
  if (!ended) return false;
  if (ended->status != 0)
    throw Error(film.string(), "ffmpeg failed, and said why above; the pictures are there");
  target.commit();
  return true;
}

}  // namespace nightcity::nightview
