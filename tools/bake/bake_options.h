// The options of a bake, one struct for each stage.
#pragma once

#include "formats/scene_writer.h"
#include "tools/bake/city/city_inputs.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/bake/scene/scene_tiles.h"
#include "tools/bake/stages/light_stage.h"
#include "tools/bake/stages/window_stage.h"
#include "tools/traffic/traffic.h"

namespace nightcity::bake {

struct BakeOptions {
  CityInputs city;
  SceneWriter::Options scene;
  SceneTileOptions tiles;
  LightStageOptions lights;
  WindowStageOptions windows;
  bool makes_traffic = false;
  bool stores_hierarchies = true;
  traffic::TrafficOptions traffic;

  /// Returns whether lamps or traffic follow streets: then a map without streets needs the model's.
  bool uses_streets() const { return makes_traffic || lights.lamps.lays_out(); }
};

/// Sorts a recipe's settings by the stage that uses them. No stage depends on the recipe itself.
BakeOptions to_bake_options(const Recipe& recipe);

/// Returns the options of a recipe's bake. Throws UsageError where its keys contradict each other.
BakeOptions make_bake_options(const Recipe& recipe);

/// Returns those of a command that does a stage by itself: the same, but of a map alone, for which
/// the recipe has no elevation model. Its lamps and streets then keep the heights of their tags.
BakeOptions make_stage_options(const Recipe& recipe);

}  // namespace nightcity::bake
