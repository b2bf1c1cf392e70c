// The command that records a film as the window shows its scene, and the folder of the film.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "formats/light_edits.h"
#include "runtime/viewer/panel.h"

namespace nightcity::viewer {

/// A film that the user asked for.
struct FilmOrder {
  std::vector<std::string> program;  // the command's first words, with what the panel cannot change
  std::filesystem::path scene, path;  // of the camera
  glm::uvec2 size{1};                 // pixels
  std::uint32_t frames = 1;           // averaged in a picture
  LightEdits edits;
};

/// Returns the words of `nightview record` that render a path with the settings of the panel; all
/// but the places of what it writes.
std::vector<std::string> make_film_words(const FilmOrder& order, const ViewerState& state);

/// The places of a film, and the whole command.
struct FilmPlace {
  std::filesystem::path folder;  // of its pictures
  std::filesystem::path film;
  std::vector<std::string> words;
};

/// Makes a folder for a film in `parent`: that in which the same film was begun, else a new one,
/// NAME or NAME-2 and so on, NAME being that of the path. It then holds the command
/// (command.txt) and the edits. Throws Error.
FilmPlace prepare_film(const std::filesystem::path& parent, const FilmOrder& order,
                       const ViewerState& state);

/// Adds edits to others, over those of the same light.
void merge_edits(const LightEdits& edits, LightEdits& all);

}  // namespace nightcity::viewer
