#include "tools/bake/scene/tile_store.h"

#include <algorithm>
#include <bit>
#include <map>
#include <span>

#include "formats/hierarchy/static_geometry.h"
#include "tools/bake/city/tile_grid.h"
#include "tools/bake/scene/atlas.h"
#include "tools/trees/model_tree.h"

namespace nightcity::bake {
namespace {

// FNV-1a's multiplier over the words, and a final mix for the low bits.
std::size_t make_hash(const glm::vec3& position, const glm::vec2& place) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const float value : {position.x, position.y, position.z, place.x, place.y})
    hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001B3u;
  return static_cast<std::size_t>(hash ^ hash >> 29);
}

// Joins equal vertices of one feature, where there are pictures those of one place in them.
// Features follow each other, so only those of the present one
// are looked up: in a small table, which stays in the cache, as one for the whole tile would not.
class Welder {
 public:
  ScenePrimitive primitive;

  // `place`: in the picture, or null where there is none.
  std::uint32_t find_index(const glm::vec3& position, std::uint32_t feature,
                           const glm::vec2* place) {
    if (primitive.positions.empty() || feature != feature_) {
      feature_ = feature;
      first_ = primitive.positions.size();
      slots_.assign(64, 0);
    }
    std::size_t slot = find(position, place ? *place : glm::vec2(0));
    if (slots_[slot] != 0) return slots_[slot] - 1;
    primitive.positions.push_back(position);
    if (place) primitive.texture_coordinates.push_back(*place);
    primitive.feature_ids.push_back(feature);
    const auto index = static_cast<std::uint32_t>(primitive.positions.size() - 1);
    slots_[slot] = index + 1;
    if (2 * (primitive.positions.size() - first_) > slots_.size()) grow();
    return index;
  }

 private:
  // Returns the slot where a vertex is or belongs: linear probing in a table whose size is a power
  // of two.
  std::size_t find(const glm::vec3& position, const glm::vec2& place) const {
    std::size_t slot = make_hash(position, place) & (slots_.size() - 1);
    while (slots_[slot] != 0 && !is(slots_[slot] - 1, position, place))
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  bool is(std::size_t vertex, const glm::vec3& position, const glm::vec2& place) const {
    return primitive.positions[vertex] == position && find_place(vertex) == place;
  }
  glm::vec2 find_place(std::size_t vertex) const {
    const auto& places = primitive.texture_coordinates;
    return places.empty() ? glm::vec2(0) : places[vertex];
  }
  void grow() {
    slots_.assign(4 * slots_.size(), 0);
    for (std::size_t i = first_; i < primitive.positions.size(); ++i)
      slots_[find(primitive.positions[i], find_place(i))] = static_cast<std::uint32_t>(i + 1);
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

// Rounding to float can take a triangle's area, in its tile or where that stands, and then nobody
// sees it.
bool is_flat(const glm::vec3 (&corners)[3], const glm::dmat4& to_model) {
  using hierarchy::is_shown, hierarchy::place;
  return !is_shown(corners[0], corners[1], corners[2]) ||
         !is_shown(place(to_model, corners[0]), place(to_model, corners[1]),
                   place(to_model, corners[2]));
}

}  // namespace

std::vector<TileStore::Triangle> make_tile_triangles(const mesh::TriangleMesh& mesh,
                                                     const city::CityObject& object,
                                                     const SurfacePictures& pictures,
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
    const auto number = static_cast<std::size_t>(&triangle - mesh.triangles.data());
    if (number < pictures.triangles.size()) made.picture = pictures.triangles[number];
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
    : size_m_(size_m),
      base_height_(base_height),
      tiles_(path),
      pictured_(path),
      stored_pieces_(path),
      pieces_(path) {}

glm::dvec3 TileStore::origin(const TileKey& tile) const {
  return {tile.column * size_m_, tile.row * size_m_, base_height_};
}

void TileStore::add(std::span<const Triangle> triangles, std::uint32_t feature, bool solid,
                    std::span<const PicturePiece> pieces) {
  if (triangles.empty()) return;
  PieceNumbers numbers;
  ObjectTiles tiles(size_m_);
  for (const Triangle& triangle : triangles) tiles.add(triangle.corners);
  for (const Triangle& triangle : triangles) {
    const Tile tile = tiles.find_tile(triangle.corners);
    const TileKey key{tile.column, tile.row, triangle.kind};
    const glm::dvec3 corner = origin(key);
    StoredTriangle stored{{}, triangle.material, feature, solid, 0};
    if (triangle.picture.piece < pieces.size())
      stored.picture = add_picture(key, triangle.picture, pieces, numbers) & 0x7FFFFFFFu;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 local = triangle.corners[i] - corner;
      stored.corners[i] = glm::vec3(glm::dvec3(local.x, local.z, -local.y));
    }
    tiles_.add(key, stored);
  }
}

// Returns the number of the picture on the triangle, from 1 on. A tile gets each piece once.
std::uint32_t TileStore::add_picture(const TileKey& key, const PicturedTriangle& picture,
                                     std::span<const PicturePiece> pieces, PieceNumbers& numbers) {
  Counts& counts = counts_[key];
  const auto [number, is_new] = numbers.try_emplace({key, picture.piece}, counts.pieces);
  if (is_new) {
    const PicturePiece& piece = pieces[picture.piece];
    stored_pieces_.add(key, {pieces_.size(), piece.width, piece.height});
    pieces_.write(piece.rgb.data(), piece.rgb.size());
    ++counts.pieces;
  }
  PicturedTriangle stored = picture;
  stored.piece = number->second;
  pictured_.add(key, stored);
  return ++counts.triangles;
}

std::vector<PicturePiece> TileStore::read_pieces(const TileKey& key) {
  std::vector<PicturePiece> pieces;
  for (const StoredPiece& stored : stored_pieces_.read(key)) {
    PicturePiece& piece = pieces.emplace_back();
    piece.width = static_cast<std::uint16_t>(stored.width);
    piece.height = static_cast<std::uint16_t>(stored.height);
    piece.rgb.resize(std::size_t{3} * stored.width * stored.height);
    pieces_.read(stored.offset, piece.rgb.data(), piece.rgb.size());
  }
  return pieces;
}

std::vector<TileKey> TileStore::tiles() {
  pictured_.keys();
  stored_pieces_.keys();
  pieces_.flush();
  return tiles_.keys();
}

TileStore::TileMesh TileStore::mesh(const TileKey& key, const glm::dmat4& to_model,
                                    const Change& change) {
  std::vector<StoredTriangle> triangles = tiles_.read(key);
  if (change) change(triangles);
  TileMesh tile;
  std::vector<PicturedTriangle> pictured;
  Atlases atlases;
  if (counts_.contains(key)) {
    pictured = pictured_.read(key);
    const std::vector<PicturePiece> pieces = read_pieces(key);
    atlases = pack_atlases(pieces);
    tile.pieces = pieces.size();
  }
  // Without its colour: under a picture that is the picture's mean.
  const auto code_of = [](const StoredTriangle& triangle) {
    return triangle.picture == 0 ? triangle.material : to_kind(triangle.material);
  };
  std::map<std::pair<std::uint32_t, MaterialCode>, Welder> welders;  // by 1 + picture, 0 = none
  for (const StoredTriangle& triangle : triangles) {
    const PicturedTriangle* picture =
        triangle.picture == 0 ? nullptr : &pictured[triangle.picture - 1];
    const Atlases::Place* at = picture ? &atlases.places[picture->piece] : nullptr;
    Welder& welder = welders[{at ? at->picture + 1 : 0, code_of(triangle)}];
    std::uint32_t index[3];
    for (int i = 0; i < 3; ++i) {
      glm::vec2 place(0);
      if (at)
        place =
            (glm::vec2(at->corner) + picture->places[i]) / glm::vec2(atlases.sizes[at->picture]);
      index[i] = welder.find_index(triangle.corners[i], triangle.feature, at ? &place : nullptr);
    }
    if (is_flat(triangle.corners, to_model)) {
      ++tile.flat;
      continue;
    }
    welder.primitive.indices.insert(welder.primitive.indices.end(), index, index + 3);
  }
  SceneMesh& mesh = tile.mesh;
  mesh.name = std::string(name_of(key.kind)) + " " + std::to_string(key.column) + " " +
              std::to_string(key.row);
  for (auto& [key_of_welder, welder] : welders) {
    if (welder.primitive.indices.empty()) continue;
    const auto [picture, code] = key_of_welder;
    welder.primitive.material = code;
    mesh.primitives.push_back(std::move(welder.primitive));
    tile.picture_of_primitive.push_back(picture == 0 ? 0 : picture - 1);
  }
  for (const glm::ivec2& size : atlases.sizes)
    tile.texels += static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
  tile.pictures = std::move(atlases.pictures);
  return tile;
}

}  // namespace nightcity::bake
