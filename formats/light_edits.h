// Edits of single lights, in a file of their own beside a scene (city.edits.json): formats/SPEC.md,
// section 5.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>

#include "formats/light.h"

namespace nightcity {

/// The values of a light that were changed; what is absent is as it was.
struct LightEdit {
  bool is_off = false;            // it never shines
  std::optional<double> flux_lm;  // finite, above 0
  std::optional<glm::vec3> aim;   // unit vector of its axis: east, north, up

  bool operator==(const LightEdit&) const = default;
  bool is_empty() const { return *this == LightEdit{}; }
};

/// Edits by the lights' ids (Light::id), which are the same after every bake.
using LightEdits = std::map<std::uint32_t, LightEdit>;

/// Reads such a file. Throws Error with file and place where it is none, or a value is out of
/// range.
LightEdits read_light_edits(const std::filesystem::path& file);
/// Writes such a file. Throws Error.
void write_light_edits(const std::filesystem::path& file, const LightEdits& edits);

/// Changes a light as an edit says, its flux to 0 where it is off. The tangent stays perpendicular
/// to the axis.
void apply_edit(const LightEdit& edit, Light& light);

/// Changes all lights that edits name, and returns how many edits name none of them.
std::size_t apply_edits(const LightEdits& edits, std::span<Light> lights);

}  // namespace nightcity
