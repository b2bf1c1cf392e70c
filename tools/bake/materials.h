// What the surfaces of a city are made of by night: one table of reflectances with their sources.
#pragma once

#include <array>
#include <cstdint>

#include "formats/scene_file.h"
#include "tools/citygml/city_model.h"

namespace nightcity {

enum class BakeMaterial : std::uint8_t {
  wall,
  roof,
  ground,  // under buildings: seen where a model floats or is cut open
  window,
  door,
  road,
  pavement,
  terrain,
  water,
  vegetation,
  furniture,
  other,
  lamp_post,
  count
};
constexpr std::size_t bake_material_count = static_cast<std::size_t>(BakeMaterial::count);

/// The scene material of each BakeMaterial, in order. Reflectances are diffuse, for visible light.
const std::array<SceneMaterial, bake_material_count>& bake_materials();

/// The kind of scene node a surface belongs to: batches of one kind share a node in a tile.
enum class NodeKind : std::uint8_t { city, terrain, road };
const char* name_of(NodeKind kind);

struct SurfaceUse {
  BakeMaterial material;
  NodeKind kind;
};

/// What a surface of an object is made of and belongs to.
SurfaceUse use_of(ObjectType object, SurfaceType surface);

}  // namespace nightcity
