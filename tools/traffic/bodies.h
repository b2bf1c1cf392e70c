// The body of each type of vehicle: a few dozen triangles in the vehicle frame.
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

/// Returns the five materials in the order of BodyMaterials. Lenses emit the mean luminance
/// of their lamps.
std::vector<SceneMaterial> body_materials(const VehicleType& type);

/// Returns a body that fits into the type's box: x forward, y up, z right, the road at y = 0;
/// metres.
SceneMesh make_body(const VehicleType& type, const BodyMaterials& materials);

}  // namespace nightcity::traffic
