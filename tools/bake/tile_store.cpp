#include "tools/bake/tile_store.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <span>
#include <unordered_map>

namespace nightcity {
namespace {

// As stored: positions already relative to the tile, in model axes.
struct StoredTriangle {
  glm::vec3 corners[3];
  std::uint32_t material;
};
static_assert(sizeof(StoredTriangle) == 40);

struct Vertex {
  glm::vec3 position;
  std::uint32_t feature;
  bool operator==(const Vertex&) const = default;
};

struct VertexHash {
  std::size_t operator()(const Vertex& v) const {
    std::uint64_t hash = v.feature;
    for (int i = 0; i < 3; ++i)  // FNV-1a's multiplier over the words, and a final mix for the low bits
      hash = (hash ^ std::bit_cast<std::uint32_t>(v.position[i])) * 0x100000001B3u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

struct Welder {
  ScenePrimitive primitive;
  std::unordered_map<Vertex, std::uint32_t, VertexHash> known;

  std::uint32_t index_of(const Vertex& vertex) {
    const auto [found, is_new] =
        known.try_emplace(vertex, static_cast<std::uint32_t>(primitive.positions.size()));
    if (is_new) {
      primitive.positions.push_back(vertex.position);
      primitive.feature_ids.push_back(vertex.feature);
    }
    return found->second;
  }
};

}  // namespace

struct TileStore::Record {
  std::uint64_t previous;  // offset + 1 of this tile's record before; 0 = none
  std::uint32_t feature, triangle_count;
};

TileStore::TileStore(const std::filesystem::path& path, double size_m, double base_height)
    : size_m_(size_m), base_height_(base_height), file_(path) {}

TileKey TileStore::key_of(const glm::dvec3& point, NodeKind kind) const {
  return {static_cast<std::int32_t>(std::floor(point.x / size_m_)),
          static_cast<std::int32_t>(std::floor(point.y / size_m_)), kind};
}

glm::dvec3 TileStore::origin(const TileKey& tile) const {
  return {tile.column * size_m_, tile.row * size_m_, base_height_};
}

void TileStore::add(std::span<const Triangle> triangles, std::uint32_t feature) {
  if (triangles.empty()) return;
  glm::dvec2 least(std::numeric_limits<double>::infinity()), greatest(-least);
  for (const Triangle& triangle : triangles)
    for (const glm::dvec3& corner : triangle.corners) {
      least = glm::min(least, glm::dvec2(corner));
      greatest = glm::max(greatest, glm::dvec2(corner));
    }
  const glm::dvec2 extent = greatest - least;
  const bool whole = std::max(extent.x, extent.y) <= size_m_;
  const glm::dvec3 centre((least + greatest) / 2.0, 0);
  // An ordered map, so that the file does not depend on hashing.
  std::map<TileKey, std::vector<const Triangle*>> parts;
  for (const Triangle& triangle : triangles) {
    const glm::dvec3 place =
        whole ? centre : (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
    parts[key_of(place, triangle.kind)].push_back(&triangle);
  }
  for (const auto& [key, part] : parts) append(key, part, feature);
}

void TileStore::append(const TileKey& key, std::span<const Triangle* const> triangles,
                       std::uint32_t feature) {
  Tile& tile = tiles_[key];
  const Record record{tile.last_record, feature, static_cast<std::uint32_t>(triangles.size())};
  tile.last_record = file_.size() + 1;
  file_.write(&record, sizeof record);
  const glm::dvec3 corner = origin(key);
  for (const Triangle* triangle : triangles) {
    StoredTriangle stored;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 local = triangle->corners[i] - corner;
      stored.corners[i] = glm::vec3(glm::dvec3(local.x, local.z, -local.y));
    }
    stored.material = static_cast<std::uint32_t>(triangle->material);
    file_.write(&stored, sizeof stored);
  }
}

std::vector<TileKey> TileStore::tiles() const {
  std::vector<TileKey> keys;
  for (const auto& [key, tile] : tiles_) keys.push_back(key);
  return keys;
}

SceneMesh TileStore::mesh(const TileKey& key) {
  std::vector<std::pair<std::uint64_t, Record>> records;
  for (std::uint64_t next = tiles_.at(key).last_record; next != 0;) {
    Record record;
    file_.read(next - 1, &record, sizeof record);
    records.emplace_back(next - 1, record);
    next = record.previous;
  }
  std::reverse(records.begin(), records.end());

  std::array<Welder, bake_material_count> welders;
  std::vector<StoredTriangle> triangles;
  for (const auto& [offset, record] : records) {
    triangles.resize(record.triangle_count);
    file_.read(offset + sizeof record, triangles.data(), triangles.size() * sizeof(StoredTriangle));
    for (const StoredTriangle& triangle : triangles) {
      Welder& welder = welders[triangle.material];
      std::uint32_t index[3];
      for (int i = 0; i < 3; ++i) index[i] = welder.index_of({triangle.corners[i], record.feature});
      // Rounding to float can join corners: such a triangle has no area.
      if (index[0] == index[1] || index[1] == index[2] || index[2] == index[0]) continue;
      welder.primitive.indices.insert(welder.primitive.indices.end(), index, index + 3);
    }
  }
  SceneMesh mesh;
  mesh.name =
      std::string(name_of(key.kind)) + " " + std::to_string(key.column) + " " + std::to_string(key.row);
  for (std::size_t m = 0; m < welders.size(); ++m) {
    if (welders[m].primitive.indices.empty()) continue;
    welders[m].primitive.material = static_cast<std::uint32_t>(m);
    mesh.primitives.push_back(std::move(welders[m].primitive));
  }
  return mesh;
}

}  // namespace nightcity
