// What a vehicle looks like: a few dozen triangles in its vehicle frame.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/scene.h"
#include "tools/traffic/vehicle_types.h"

namespace nightcity::traffic {

/// Materials of the scene that bodies are made of.
struct BodyMaterials {
  std::uint32_t paint, glass, tyre, headlamp, tail_lamp;
};

/// The five materials in the order of BodyMaterials. Lenses glow with the mean luminance of their lamps.
std::vector<SceneMaterial> body_materials(const VehicleType& type);

/// Inside the type's box: x forward, y up, z right, the road at y = 0.
SceneMesh make_body(const VehicleType& type, const BodyMaterials& materials);

}  // namespace nightcity::traffic
