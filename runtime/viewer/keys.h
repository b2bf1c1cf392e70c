// The keys of the window: one table for what they do, the help in the window and the documents.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace nightcity::viewer {

enum class Action {
  move,  // held keys: see controls.h
  estimator,
  markers,
  next_motion,
  compare,
  next_view,
  go_to_place,
  record_path,
  film,
  switch_light,
  dim_light,
  brighten_light,
  save_edits,
  measure,
  save_settings,
  save_picture,
  play,
  panel,
  help,
  close,
  undo_move,
  copy_camera,
  paste_camera,
  bookmark,
  go_to_bookmark,
  next_city,
  previous_city,
  fullscreen,
  larger_text,
  smaller_text,
};

struct KeyBinding {
  const char* keys;  // as people call them
  const char* help;
  Action action;
  bool needs_scene = false;  // else it is obeyed while the first scene is being opened, too
};

/// Returns all keys, in the order in which the help lists them.
const std::vector<KeyBinding>& list_keys();

/// Returns what people call the keys of an action that needs a scene, null for others.
const char* find_keys_for_scene(Action action);

/// Returns what the mouse does, as pairs of gesture and effect.
const std::vector<std::pair<const char*, const char*>>& list_gestures();

/// A key that was pressed, as the window reports it.
struct KeyPress {
  Action action;
  int number = 0;  // of the digit or function key, from 1
};

/// Returns what a key (GLFW_KEY_*) with modifiers (GLFW_MOD_*) asks for, nothing where it is held
/// to move or means nothing.
std::optional<KeyPress> find_action(int key, int modifiers);

}  // namespace nightcity::viewer
