#include "runtime/viewer/film_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/small_file.h"
#include "runtime/render/parse.h"
#include "runtime/render/setting_table.h"
#include "runtime/render/settings_file.h"
#include "runtime/viewer/window_settings.h"

namespace nightcity::viewer {
namespace {

namespace fs = std::filesystem;

constexpr int max_folders = 1000;

// Returns AZIMUTH,ELEVATION,LUX, from which set_moon makes the same moon, in its colour.
std::string describe_moon(const render::EnvironmentSettings& environment) {
  const glm::dvec3 way = environment.moon_direction;
  const double turn = glm::degrees(std::atan2(way.x, -way.z)),
               azimuth = turn < 0 ? turn + 360 : turn,
               elevation = glm::degrees(std::asin(std::clamp(way.y, -1.0, 1.0)));
  render::EnvironmentSettings of_one_lux;
  render::set_moon(of_one_lux, azimuth, elevation, 1);
  return fmt::format("{:.4f},{:.4f},{:.6g}", azimuth, elevation,
                     environment.moon_lux.g / of_one_lux.moon_lux.g);
}

// Returns a command as a shell takes it.
std::string to_shell(const std::vector<std::string>& words) {
  std::string text = "nightview";
  for (std::size_t i = 1; i < words.size(); ++i) {
    std::string quoted;
    for (const char c : words[i]) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    const bool is_plain = words[i].find_first_not_of(
                              "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789-_=.,:/") == std::string::npos;
    text += is_plain ? " " + words[i] : " '" + quoted + "'";
  }
  return text + "\n";
}

bool holds_film(const fs::path& folder, const std::string& command, const LightEdits& edits) {
  try {
    const fs::path file = folder / "edits.json";
    return read_small_file(folder / "command.txt") == command &&
           (fs::exists(file) ? read_light_edits(file) : LightEdits{}) == edits;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> make_film_words(const FilmOrder& order, const ViewerState& state) {
  const render::RenderSettings& settings = state.settings;
  std::vector<std::string> words = order.program;
  words.push_back(order.scene.string());
  const auto add = [&](const std::string& name, const std::string& value) {
    words.push_back("--" + name + "=" + value);
  };
  add("path", order.path.string());
  add("size", fmt::format("{}x{}", order.size.x, order.size.y));
  add("duration", fmt::format("{:g}", state.film.duration_s));
  add("fps", fmt::format("{:g}", state.film.pictures_per_s));
  add("clock-speed", fmt::format("{:g}", state.play ? state.clock_speed : 0));
  add("frames", std::to_string(order.frames));
  for (const render::NamedText& value : list_window_values(state)) add(value.name, value.text);
  if (settings.environment.moon_lux != glm::vec3(0))
    add("moon", describe_moon(settings.environment));
  return words;
}

FilmPlace prepare_film(const fs::path& parent, const FilmOrder& order, const ViewerState& state) {
  const std::string name = order.path.stem().string();
  for (int number = 1; number < max_folders; ++number) {
    FilmPlace place;
    place.folder = parent / (number == 1 ? name : fmt::format("{}-{}", name, number));
    place.film = place.folder.string() + ".mp4";
    place.words = make_film_words(order, state);
    place.words.push_back("--out=" + place.folder.string());
    place.words.push_back("--film=" + place.film.string());
    if (!order.edits.empty())
      place.words.push_back("--edits=" + (place.folder / "edits.json").string());
    const std::string command = to_shell(place.words);
    std::error_code failed;
    if (fs::exists(place.folder, failed)) {
      if (holds_film(place.folder, command, order.edits)) return place;
      continue;
    }
    if (!fs::create_directories(place.folder, failed))
      throw Error(place.folder.string(), "cannot be made: " + failed.message());
    if (!order.edits.empty()) write_light_edits(place.folder / "edits.json", order.edits);
    AtomicFile file(place.folder / "command.txt");
    file.write(command);
    file.commit();
    return place;
  }
  throw Error(parent.string(), "holds a film of every number");
}

void merge_edits(const LightEdits& edits, LightEdits& all) {
  for (const auto& [id, edit] : edits) {
    LightEdit& merged = all[id];
    merged.is_off |= edit.is_off;
    if (edit.flux_lm) merged.flux_lm = edit.flux_lm;
    if (edit.aim) merged.aim = edit.aim;
  }
}

}  // namespace nightcity::viewer
