#include "runtime/nightview/recording.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/night.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/png.h"
#include "runtime/render/parse.h"
#include "runtime/render/setting_table.h"

extern char** environ;

namespace nightcity::nightview {
namespace {

namespace fs = std::filesystem;

std::string name_of_picture(std::uint32_t number, const char* extension) {
  return fmt::format("frame-{:05}{}", number, extension);
}

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
      {"width", renderer.width()},
      {"height", renderer.height()},
      {"settings", values}};
  if (settings.environment.lights != scene::all_families)
    description["lights"] = scene::text_of(settings.environment.lights);
  if (settings.projection != PROJECTION_PERSPECTIVE)
    description["projection"] = settings.projection;
  return description;
}

// Returns the exposure that an earlier run of the same recording chose. Throws Error where the
// folder holds another one.
std::optional<float> find_earlier(const fs::path& file, const nlohmann::json& wanted) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  const auto found = nlohmann::json::parse(in, nullptr, false);
  if (!found.is_object() || !found.contains("recording") || found["recording"] != wanted)
    throw Error(file.string(),
                "this folder holds another recording, or one with other options: remove it, or "
                "name another folder");
  if (!found.contains("ev100") || !found["ev100"].is_number()) return std::nullopt;
  return found["ev100"].get<float>();
}

void write_description(const fs::path& file, const nlohmann::json& recording,
                       std::optional<float> ev100) {
  nlohmann::json document{{"recording", recording}};
  if (ev100) document["ev100"] = *ev100;
  AtomicFile out(file);
  out.write(document.dump(2) + "\n");
  out.commit();
}

void write_picture(const RecordingOptions& options, std::uint32_t number,
                   const measure::Image& image, std::uint32_t tone) {
  // The PNG comes last: where it is, the picture is whole.
  if (options.exr) measure::write_exr(options.folder / name_of_picture(number, ".exr"), image);
  measure::write_png(options.folder / name_of_picture(number, ".png"),
                     measure::to_display(image, *image.info.ev100, tone),
                     measure::png_text(image.info));
}

}  // namespace

std::uint32_t count_pictures(const RecordingOptions& options) {
  return static_cast<std::uint32_t>(
      std::max(1.0, std::round(options.duration_s * options.pictures_per_s)));
}

std::uint32_t record(const RecordingOptions& options, render::Renderer& renderer,
                     const scene::RenderScene& scene, const scene::CameraPath& path,
                     render::RenderSettings settings,
                     const std::function<void(std::uint32_t)>& progress) {
  const nlohmann::json description = describe(options, renderer, path, settings);
  const fs::path file = options.folder / "record.json";
  const std::optional<float> earlier = find_earlier(file, description);
  std::optional<float> ev100 = options.ev100 ? options.ev100 : earlier;
  write_description(file, description, ev100);
  const std::uint32_t pictures = count_pictures(options), seed = settings.sampling.seed;
  const double begin_s = settings.time_s;
  settings.sampling.layers = options.exr;
  std::uint32_t rendered = 0;
  for (std::uint32_t i = 0; i < pictures; ++i) {
    if (!fs::exists(options.folder / name_of_picture(i, ".png"))) {
      settings.time_s =
          std::min(begin_s + i / options.pictures_per_s * options.clock_speed, double(night_end_s));
      settings.sampling.seed = seed + i;  // other settings: nothing of the picture before is reused
      const scene::CameraPose pose = path.at(pictures > 1 ? double(i) / (pictures - 1) : 0);
      for (std::uint32_t k = 0; k < options.frames; ++k) renderer.render_frame(pose, settings);
      measure::Image image = renderer.download(options.exr);
      if (!ev100) {
        ev100 = measure::auto_exposure_ev100(renderer.sample_mean(image.pixels()));
        write_description(file, description, ev100);
      }
      image.info.ev100 = ev100;
      image.info.licences = scene::describe_licences(scene);
      image.info.camera = scene::to_text(pose);
      image.info.time = render::time_text(settings.time_s);
      write_picture(options, i, image, settings.display.tone);
      ++rendered;
    }
    progress(i + 1);
  }
  return rendered;
}

bool make_film(const RecordingOptions& options, const fs::path& film) {
  // ffmpeg writes under another name first, so that the film's name never holds half of one.
  AtomicPath target(film);
  const std::string rate = fmt::format("{}", options.pictures_per_s),
                    pictures = (options.folder / "frame-%05d.png").string(),
                    scratch = target.scratch().string();
  // Sides of H.264 in 4:2:0 are even.
  const std::vector<std::string> words{"ffmpeg",
                                       "-y",
                                       "-loglevel",
                                       "error",
                                       "-nostdin",
                                       "-framerate",
                                       rate,
                                       "-i",
                                       pictures,
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
                                       scratch};
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, "ffmpeg", nullptr, nullptr, arguments.data(), environ);
  if (failed == ENOENT) return false;
  int status = 0;
  if (failed != 0 || ::waitpid(child, &status, 0) != child) throw Error("ffmpeg", "cannot be run");
  if (status == 127 << 8) return false;
  if (status != 0)
    throw Error(film.string(), "ffmpeg failed, and said why above; the pictures are there");
  target.commit();
  return true;
}

}  // namespace nightcity::nightview
