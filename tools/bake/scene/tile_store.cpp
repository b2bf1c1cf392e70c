#include "tools/bake/scene/tile_store.h"

#include <algorithm>
#include <bit>
#include <map>
#include <span>

#include "tools/bake/city/tile_grid.h"
#include "tools/trees/model_tree.h"

namespace nightcity::bake {
namespace {

// FNV-1a's multiplier over the words, and a final mix for the low bits.
std::size_t make_hash(const glm::vec3& position) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (int i = 0; i < 3; ++i)
    hash = (hash ^ std::bit_cast<std::uint32_t>(position[i])) * 0x100000001B3u;
  return static_cast<std::size_t>(hash ^ hash >> 29);
}

// Joins equal vertices of one feature. Features follow each other, so only those of the present one
// are looked up: in a small table, which stays in the cache, as one for the whole tile would not.
class Welder {
 public:
  ScenePrimitive primitive;

  std::uint32_t find_index(const glm::vec3& position, std::uint32_t feature) {
    if (primitive.positions.empty() || feature != feature_) {
      feature_ = feature;
      first_ = primitive.positions.size();
      slots_.assign(64, 0);
    }
    std::size_t slot = find(position);
    if (slots_[slot] != 0) return slots_[slot] - 1;
    primitive.positions.push_back(position);
    primitive.feature_ids.push_back(feature);
    const auto index = static_cast<std::uint32_t>(primitive.positions.size() - 1);
    slots_[slot] = index + 1;
    if (2 * (primitive.positions.size() - first_) > slots_.size()) grow();
    return index;
  }

 private:
  // Returns the slot where `position` is or belongs: linear probing in a table whose size is a
  // power of two.
  std::size_t find(const glm::vec3& position) const {
    std::size_t slot = make_hash(position) & (slots_.size() - 1);
    while (slots_[slot] != 0 && primitive.positions[slots_[slot] - 1] != position)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    slots_.assign(4 * slots_.size(), 0);
    for (std::size_t i = first_; i < primitive.positions.size(); ++i)
      slots_[find(primitive.positions[i])] = static_cast<std::uint32_t>(i + 1);
  }

  std::uint32_t feature_ = 0;
  std::size_t first_ = 0;             // of the present feature's vertices
  std::vector<std::uint32_t> slots_;  // index + 1; 0 = free
};

}  // namespace

namespace {

// Returns what plants of the model are like that are surfaces: by their height, which is that of
// grass or of scrub (assumptions); unknown heights are those of forests.
MaterialCode find_plant_material(const city::CityObject& object) {
  const auto height = object.plant ? object.plant->height_m : std::nullopt;
  if (!height || *height >= trees::min_wood_m) return to_code(BakeMaterial::vegetation);
  return to_code(*height < trees::min_tree_m ? ground_cover::GroundKind::grass
                                             : ground_cover::GroundKind::scrub);
}

}  // namespace

std::vector<TileStore::Triangle> make_tile_triangles(const mesh::TriangleMesh& mesh,
                                                     const city::CityObject& object,
                                                     bool leave_out_ground) {
  std::vector<TileStore::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const mesh::MeshTriangle& triangle : mesh.triangles) {
    if (leave_out_ground && triangle.surface == city::SurfaceType::ground) continue;
    const SurfaceUse use = find_use(object.type, triangle.surface);
    TileStore::Triangle& made = triangles.emplace_back();
    for (int k = 0; k < 3; ++k) made.corners[k] = mesh.positions[triangle.vertex[k]];
    made.material = use.material == BakeMaterial::vegetation ? find_plant_material(object)
                                                             : to_code(use.material);
    made.kind = use.kind;
    if (triangle.polygon < object.polygons.size())
      if (const auto& colour = object.polygons[triangle.polygon].diffuse_colour)
        made.material = to_code(use.material, *colour);
  }
  return triangles;
}

void add_mesh(TileStore& tiles, const mesh::TriangleMesh& mesh, city::ObjectType type,
              std::uint32_t feature) {
  city::CityObject plain;
  plain.type = type;
  tiles.add(make_tile_triangles(mesh, plain), feature);
}

TileStore::TileStore(const std::filesystem::path& path, double size_m, double base_height)
    : size_m_(size_m), base_height_(base_height), tiles_(path) {}

glm::dvec3 TileStore::origin(const TileKey& tile) const {
  return {tile.column * size_m_, tile.row * size_m_, base_height_};
}

void TileStore::add(std::span<const Triangle> triangles, std::uint32_t feature, bool solid) {
  if (triangles.empty()) return;
  ObjectTiles tiles(size_m_);
  for (const Triangle& triangle : triangles) tiles.add(triangle.corners);
  for (const Triangle& triangle : triangles) {
    const Tile tile = tiles.find_tile(triangle.corners);
    const TileKey key{tile.column, tile.row, triangle.kind};
    const glm::dvec3 corner = origin(key);
    StoredTriangle stored{{}, triangle.material, feature, solid};
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 local = triangle.corners[i] - corner;
      stored.corners[i] = glm::vec3(glm::dvec3(local.x, local.z, -local.y));
    }
    tiles_.add(key, stored);
  }
}

std::vector<TileKey> TileStore::tiles() {
  return tiles_.keys();
}

SceneMesh TileStore::mesh(const TileKey& key, const Change& change) {
  std::vector<StoredTriangle> triangles = tiles_.read(key);
  if (change) change(triangles);
  std::map<MaterialCode, Welder> welders;
  for (const StoredTriangle& triangle : triangles) {
    Welder& welder = welders[triangle.material];
    std::uint32_t index[3];
    for (int i = 0; i < 3; ++i) index[i] = welder.find_index(triangle.corners[i], triangle.feature);
    // Rounding to float can join corners: such a triangle has no area.
    if (index[0] == index[1] || index[1] == index[2] || index[2] == index[0]) continue;
    welder.primitive.indices.insert(welder.primitive.indices.end(), index, index + 3);
  }
  SceneMesh mesh;
  mesh.name = std::string(name_of(key.kind)) + " " + std::to_string(key.column) + " " +
              std::to_string(key.row);
  for (auto& [code, welder] : welders) {
    if (welder.primitive.indices.empty()) continue;
    welder.primitive.material = code;
    mesh.primitives.push_back(std::move(welder.primitive));
  }
  return mesh;
}

}  // namespace nightcity::bake
