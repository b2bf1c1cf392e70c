// The parts of a scene that can be left out when it is loaded: how many things of each a scene has,
// and its lights without them.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/scene.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// Returns whether the set has the part.
inline bool holds(const PartSet& parts, Part part) {
  return parts[static_cast<std::size_t>(part)];
}

/// Counts what the lights and nodes of a scene have of each part. The colours and the water of its
/// materials are counted by count_materials.
PartCounts count_parts(const SceneLights& lights, const Scene& scene);
void count_materials(const RenderScene& scene, PartCounts& counts);

/// The fate of a light that geometry refers to, where it does not keep its number.
constexpr std::uint32_t unlinked_light = NO_HIT;      // its surface shines as its material says
constexpr std::uint32_t left_out_light = NO_HIT - 1;  // its surface is left out as well

/// Changes `lights` as `left_out` asks for:
/// windows: their lights are removed; traffic: trips and vehicles are removed;
/// profiles: every light shines alike in all directions, with the same flux;
/// aim: lamps with a profile look straight down, with their C = 0 half-plane towards the east;
/// lamp sizes: lamps are points; schedules: every light is on at all times.
/// Returns the new number of each light, unlinked_light or left_out_light; empty where all numbers
/// stay.
std::vector<std::uint32_t> leave_out_lights(SceneLights& lights, const PartSet& left_out);

/// Returns whether a node belongs to a part that is left out: panes of windows, bodies of lamps,
/// trees, vehicles.
bool is_left_out(const SceneNode& node, const PartSet& left_out);

/// Changes the materials as `left_out` asks for. Colours: all surfaces reflect the mean of all
/// triangles, weighted by area (a mesh that is placed many times counts once). Water: it is as
/// rough as other surfaces.
void leave_out_of_materials(RenderScene& scene, const PartSet& left_out);

}  // namespace nightcity::scene
