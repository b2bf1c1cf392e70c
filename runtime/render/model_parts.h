// The one table of the parts of a picture's model that can be left out. --leave-out, settings files
// and `nightview price` are made from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/render/settings.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::render {

/// A part of the model: something of the scene that is not loaded, or a light or an effect that the
/// settings turn off. A new one is a row in model_parts.cpp.
struct ModelPart {
  const char* name;  // as --leave-out takes it
  const char* help;  // what is rendered instead
  // The part of the scene (runtime/scene/parts.h) that this is, if it is one.
  std::optional<scene::Part> of_scene = std::nullopt;
  // Lamps look otherwise without it where they are seen themselves, whatever they light.
  bool changes_lamps_seen = false;
  // These say whether the settings have it, and turn it off.
  bool (*is_set)(const RenderSettings& settings) = nullptr;
  void (*turn_off)(RenderSettings& settings) = nullptr;
};

const std::vector<ModelPart>& list_model_parts();

/// Returns the names of all parts with their help, for a list of options.
std::string describe_model_parts();

/// Returns whether the scene with these settings has anything of a part, whether it was left out
/// when the scene was loaded or not.
bool is_present(const ModelPart& part, const scene::RenderScene& scene,
                const RenderSettings& settings);

/// Returns the names of parts of a scene, separated by commas.
std::string name_parts(const scene::PartSet& parts);

/// A set of parts that are left out.
class LeftOut {
 public:
  LeftOut() = default;
  /// Takes names separated by commas; "" and "none" are the empty set. Throws UsageError with the
  /// names of all parts.
  explicit LeftOut(const std::string& names);

  void add(const ModelPart& part);
  void remove(const ModelPart& part);
  bool holds(const ModelPart& part) const;
  bool empty() const { return parts_.empty(); }

  /// Returns the names in the table's order, separated by commas.
  std::string text() const;
  /// Returns what is not to be loaded.
  scene::PartSet of_scene() const;
  /// Turns off what belongs to the settings.
  void apply(RenderSettings& settings) const;

 private:
  std::vector<const ModelPart*> parts_;  // in the table's order
};

}  // namespace nightcity::render
