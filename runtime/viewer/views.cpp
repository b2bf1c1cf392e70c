#include "runtime/viewer/views.h"

#include <algorithm>

#include "formats/error.h"
#include "shaders/views.glsl.h"

namespace nightcity::viewer {

const std::vector<ViewKind>& list_views() {
  static const std::vector<ViewKind> views{
      {VIEW_PICTURE, "picture", "as a camera takes it"},
      {VIEW_LUMINANCE, "luminance", "of the picture", "cd/m2", 0.001f, 100},
      {VIEW_ILLUMINANCE, "illuminance", "of surfaces, as if they were matt", "lx", 0.01f, 100},
      {VIEW_DIRECT, "direct illuminance", "straight from lights and sky", "lx", 0.01f, 100},
      {VIEW_INDIRECT, "indirect illuminance", "after a bounce at least", "lx", 0.01f, 100},
      {VIEW_KINDS, "kinds of light", "a colour for each kind of source, by its share of the light"},
      {VIEW_OBJECTS, "city objects", "a colour for each"},
      {VIEW_HISTORY, "history", "frames whose candidates a pixel's reservoir stands for", "frames",
       1, 100},
      {VIEW_NOISE, "noise",
       "standard error of the mean over the mean, as if frames were independent", "", 0.001f, 1},
      {VIEW_WIREFRAME, "wireframe", "the picture with the edges of all triangles"},
      {VIEW_TILES, "tiles",
       "a colour for each piece of 256 triangles: small where the model is dense"},
      {VIEW_DIFFERENCE, "difference",
       "of the mean from the reference estimator's, which is rendered by turns with it", "%", 0,
       0.5f, true},
  };
  return views;
}

void show_view(const ViewKind& view, render::DisplaySettings& display) {
  display.view = view.view;
  if (!view.unit) return;
  if (!view.is_signed) display.view_lowest = view.lowest;
  display.view_highest = view.highest;
}

const ViewKind& find_view(const std::string& name) {
  std::string names;
  for (const ViewKind& view : list_views()) {
    std::string word = view.name;
    std::replace(word.begin(), word.end(), ' ', '-');
    if (word == name) return view;
    names += (names.empty() ? "" : ", ") + word;
  }
  throw UsageError("--show", "'" + name + "' is no view: " + names);
}

const std::vector<KindColour>& list_kind_colours() {
  static const std::vector<KindColour> colours{
      {"street lamps", {KIND_COLOUR_LAMPS}}, {"windows", {KIND_COLOUR_WINDOWS}},
      {"vehicles", {KIND_COLOUR_VEHICLES}},  {"sky and moon", {KIND_COLOUR_SKY}},
      {"bounced", {KIND_COLOUR_INDIRECT}},   {"seen directly", {KIND_COLOUR_EMITTED}},
  };
  return colours;
}

}  // namespace nightcity::viewer
