// Chooses the values of a lamp from its tags, the road beside it and the table of defaults.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "formats/light_file.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lamp_tags.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::lights {

/// A value and where it came from.
template <class T>
struct Known {
  T value;
  ValueSource source = ValueSource::rule;
  void tagged(const std::optional<T>& tag) {
    if (tag) value = *tag, source = ValueSource::tag;
  }
};

/// The values of a post's luminaires, each with its source.
struct LampValues {
  Known<double> mounting_m;
  Known<Optic> optic;
  Known<double> flux_lm, cct_k;
  Known<glm::vec3> colour;
  const LuminaireChoice* measured = nullptr;  // instead of the optic
};

/// Returns the values of a post's luminaires.
LampValues choose_values(const LampTags& tags, const RoadLighting& defaults,
                         const LampOptions& options);

/// Returns how far the luminous centre is in front of its post, in metres; at most up to the
/// centreline of the road, if there is one, at `to_centreline_m` from the post.
double choose_outreach(const LampTags& tags, const RoadLighting& defaults,
                       std::optional<double> to_centreline_m, std::size_t luminaires);

}  // namespace nightcity::lights
