// The materials of a city's surfaces: one table of reflectances with their sources.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string_view>

#include "formats/scene_writer.h"
#include "tools/bake/scene/skins.h"
#include "tools/barriers/barrier_kind.h"
#include "tools/city/city_model.h"
#include "tools/ground_cover/ground_kind.h"

namespace nightcity::bake {

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

/// Returns the scene material of each BakeMaterial, in order. Reflectances are diffuse, for visible
/// light.
const std::array<SceneMaterial, bake_material_count>& bake_materials();

/// A material with the colour that the model gives it, packed: the kind in the low 7 bits, bit 7
/// set where there is a colour, and above them 8 bits each of red, green and blue (sRGB). Without a
/// colour, the bits above are 0 or say which skin the surface has.
using MaterialCode = std::uint32_t;

constexpr MaterialCode to_code(BakeMaterial kind) {
  return static_cast<MaterialCode>(kind);
}
/// `colour`: sRGB in [0, 1], as in X3DMaterial (CityGML 2.0, appearance).
MaterialCode to_code(BakeMaterial kind, const glm::vec3& colour);
constexpr MaterialCode to_code(BakeMaterial kind, Skin skin) {
  return to_code(kind) | (static_cast<MaterialCode>(skin.finish) * 256 + skin.shade + 1) << 8;
}
/// Kinds of ground come behind the other kinds.
constexpr MaterialCode to_code(ground_cover::GroundKind kind) {
  return static_cast<MaterialCode>(bake_material_count) + static_cast<MaterialCode>(kind);
}
/// Materials of barriers come behind the kinds of ground.
constexpr MaterialCode to_code(barriers::BarrierMaterial material) {
  return static_cast<MaterialCode>(bake_material_count + ground_cover::ground_kind_count) +
         static_cast<MaterialCode>(material);
}
/// Returns the code of the material's kind, without colour or skin.
constexpr MaterialCode to_kind(MaterialCode code) {
  return code & 0x7F;
}
/// Returns the kind of ground of a material; none where it is of another kind.
std::optional<ground_cover::GroundKind> to_ground_kind(MaterialCode code);
/// Returns a code's material without the colour that a model gives it, and without its skin.
SceneMaterial find_material(MaterialCode code);

/// Returns whether a material is of that kind, whatever its colour or skin.
bool is_of_kind(MaterialCode code, BakeMaterial kind);

/// Returns whether the material of that name is of that kind, with or without a colour or a skin:
/// "roof", "roof #804000" and "roof tiles 2" are roofs.
bool is_of_kind(std::string_view name, std::string_view kind);

/// The materials of a scene: those of the table, and one for each kind of ground, each material of
/// barriers, each skin and each colour, added when it is first used.
class MaterialTable {
 public:
  /// Adds bake_materials() to `writer`, in order.
  explicit MaterialTable(SceneWriter& writer);
  /// Returns the writer's index. When there are 2000 colours, the nearest of these is taken for any
  /// other: a model with a colour for each polygon stores a photograph in this way.
  std::uint32_t find_index(MaterialCode code);
  /// Adds a material of the code's kind under a picture of the writer's.
  std::uint32_t add_pictured(MaterialCode code, std::uint32_t picture);
  std::size_t colours() const { return coloured_.size(); }

 private:
  std::uint32_t find_coloured(MaterialCode code);

  SceneWriter& writer_;
  std::map<MaterialCode, std::uint32_t> plain_;  // all without a colour but those of the table
  std::map<MaterialCode, std::uint32_t> coloured_;
};

/// The kind of scene node that a surface belongs to: surfaces of one kind share a node in a tile.
enum class NodeKind : std::uint8_t { city, terrain, road, barrier, bridge };
const char* name_of(NodeKind kind);

struct SurfaceUse {
  BakeMaterial material;
  NodeKind kind;
};

/// Returns what a surface of an object is made of, and the kind of node it belongs to.
SurfaceUse find_use(city::ObjectType object, city::SurfaceType surface);

}  // namespace nightcity::bake
