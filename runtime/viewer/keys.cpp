#include "runtime/viewer/keys.h"

#include <GLFW/glfw3.h>

namespace nightcity::viewer {

const std::vector<KeyBinding>& list_keys() {
  static const std::vector<KeyBinding> keys{
      {"W A S D", "move ahead, left, back and right", Action::move, true},
      {"Q E", "move down and up (not when walking)", Action::move, true},
      {"Shift", "held: move five times as fast", Action::move, true},
      {"F", "orbit, fly or walk: the next of the three", Action::next_motion, true},
      {"Z", "take the last move back", Action::undo_move, true},
      {"B", "set a bookmark here; F2 to F9 go to the first eight", Action::bookmark, true},
      {"F2 to F9", "go to a bookmark", Action::go_to_bookmark, true},
      {"G",
       "go to a place: latitude and longitude, coordinates of the CRS, a street, or an object's id",
       Action::go_to_place, true},
      {"R", "record the way of the camera, and end that", Action::record_path, true},
      {"Ctrl+R", "film the path that was recorded last, or the bookmarks", Action::film, true},
      {"Ctrl+C", "copy the camera as one line of text", Action::copy_camera, true},
      {"Ctrl+V", "go to the camera in the clipboard", Action::paste_camera, true},
      {"Space", "start and stop the clock", Action::play},
      {"1 to 6", "choose the estimator", Action::estimator},
      {"O", "switch the light that was clicked off or on", Action::switch_light, true},
      {",", "dim it", Action::dim_light, true},
      {".", "brighten it", Action::brighten_light, true},
      {"Ctrl+E", "save the edits of lights", Action::save_edits, true},
      {"N", "measure distances from the point that was clicked", Action::measure, true},
      {"M", "show markers of lamps", Action::markers},
      {"X", "compare two pictures, A and B, left and right of a line", Action::compare},
      {"V", "show the next of the picture, luminance, illuminance and the other views",
       Action::next_view},
      {"P", "save the picture as night-NNN.png and .exr", Action::save_picture, true},
      {"Ctrl+S", "save the settings as a file for --settings", Action::save_settings},
      {"Page Down", "open the next of the cities in the panel", Action::next_city, true},
      {"Page Up", "open the one before", Action::previous_city, true},
      {"Tab", "show or hide the panel", Action::panel},
      {"Ctrl +, Ctrl -", "larger and smaller text", Action::larger_text},
      {"F11", "fill the screen, or not", Action::fullscreen},
      {"F1, H", "show or hide this list", Action::help},
      {"Esc",
       "close what is open: a list, this help, what was clicked, a picture being saved, a film; "
       "then the window",
       Action::close},
  };
  return keys;
}

const char* find_keys_for_scene(Action action) {
  for (const KeyBinding& key : list_keys())
    if (key.action == action && key.needs_scene) return key.keys;
  return nullptr;
}

const std::vector<std::pair<const char*, const char*>>& list_gestures() {
  static const std::vector<std::pair<const char*, const char*>> gestures{
      {"left button", "orbits about the point that was pressed; flying or walking: looks around"},
      {"right or middle button", "moves along the ground; the point under the cursor follows it"},
      {"wheel", "comes nearer to what is under the cursor; flying: changes the speed"},
      {"click", "shows what is there: object, lux, cd/m2, the strongest lights and their sources"},
      {"drag the line", "between A and B: moves it"},
      {"drop a .glb or folder", "opens that city"},
  };
  return gestures;
}

std::optional<KeyPress> find_action(int key, int modifiers) {
  if ((modifiers & GLFW_MOD_CONTROL) != 0) {
    switch (key) {
      case GLFW_KEY_C:
        return KeyPress{Action::copy_camera};
      case GLFW_KEY_V:
        return KeyPress{Action::paste_camera};
      case GLFW_KEY_E:
        return KeyPress{Action::save_edits};
      case GLFW_KEY_R:
        return KeyPress{Action::film};
      case GLFW_KEY_S:
        return KeyPress{Action::save_settings};
      case GLFW_KEY_Z:
        return KeyPress{Action::undo_move};
      case GLFW_KEY_EQUAL:
      case GLFW_KEY_KP_ADD:
        return KeyPress{Action::larger_text};
      case GLFW_KEY_MINUS:
      case GLFW_KEY_KP_SUBTRACT:
        return KeyPress{Action::smaller_text};
      default:
        return std::nullopt;
    }
  }
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) return KeyPress{Action::estimator, key - GLFW_KEY_0};
  if (key >= GLFW_KEY_F2 && key <= GLFW_KEY_F9)
    return KeyPress{Action::go_to_bookmark, key - GLFW_KEY_F1};
  switch (key) {
    case GLFW_KEY_F:
      return KeyPress{Action::next_motion};
    case GLFW_KEY_Z:
      return KeyPress{Action::undo_move};
    case GLFW_KEY_B:
      return KeyPress{Action::bookmark};
    case GLFW_KEY_SPACE:
      return KeyPress{Action::play};
    case GLFW_KEY_M:
      return KeyPress{Action::markers};
    case GLFW_KEY_G:
      return KeyPress{Action::go_to_place};
    case GLFW_KEY_R:
      return KeyPress{Action::record_path};
    case GLFW_KEY_O:
      return KeyPress{Action::switch_light};
    case GLFW_KEY_COMMA:
      return KeyPress{Action::dim_light};
    case GLFW_KEY_PERIOD:
      return KeyPress{Action::brighten_light};
    case GLFW_KEY_N:
      return KeyPress{Action::measure};
    case GLFW_KEY_V:
      return KeyPress{Action::next_view};
    case GLFW_KEY_X:
      return KeyPress{Action::compare};
    case GLFW_KEY_P:
      return KeyPress{Action::save_picture};
    case GLFW_KEY_PAGE_DOWN:
      return KeyPress{Action::next_city};
    case GLFW_KEY_PAGE_UP:
      return KeyPress{Action::previous_city};
    case GLFW_KEY_TAB:
      return KeyPress{Action::panel};
    case GLFW_KEY_F11:
      return KeyPress{Action::fullscreen};
    case GLFW_KEY_H:
    case GLFW_KEY_F1:
      return KeyPress{Action::help};
    case GLFW_KEY_ESCAPE:
      return KeyPress{Action::close};
    default:
      return std::nullopt;
  }
}

}  // namespace nightcity::viewer
