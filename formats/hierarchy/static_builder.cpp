#include "formats/hierarchy/static_builder.h"

#include <optional>
#include <utility>

#include "formats/hierarchy/cutting_build.h"
#include "formats/hierarchy/static_geometry.h"
#include "formats/hierarchy/triangle_pieces.h"
#include "formats/hierarchy/wall_directions.h"
#include "formats/scene_reader.h"

namespace nightcity::hierarchy {
namespace {

glm::vec3 to_vec3(Float4 p) {
  return {p[0], p[1], p[2]};
}

// Gathers the pieces of triangles that come one by one.
class PieceGatherer {
 public:
  // `most`: there are so many triangles at most. Memory is taken when it is written to, so that room
  // for all costs nothing, and no copies are made as they become more.
  PieceGatherer(std::size_t most, const BoxFrame& frame) : frame_(frame) {
    result_.pieces.reserve(most + find_room(most));
    result_.large.reserve(most);
  }
  void add(const Corners& triangle) {
    chunk_.push_back(triangle);
    if (chunk_.size() == piece_chunk) end_chunk();
  }
  // To be called once, after the last triangle.
  CutPieces take() {
    end_chunk();
    return std::move(result_);
  }
  std::uint32_t triangles() const { return triangles_; }
  // Returns their box in the scene's own frame.
  const Bounds& box() const { return box_; }

 private:
  void end_chunk() {
    made_.clear();
    append_pieces(chunk_, true, triangles_, frame_, made_, &result_.large);
    for (const Corners& triangle : chunk_) box_.grow(triangle.bounds());
    result_.pieces.insert(result_.pieces.end(), made_.begin(), made_.end());
    triangles_ += static_cast<std::uint32_t>(chunk_.size());
    chunk_.clear();
  }

  const BoxFrame& frame_;
  Bounds box_;
  std::vector<Corners> chunk_;
  std::vector<TrianglePiece> made_;
  CutPieces result_;
  std::uint32_t triangles_ = 0;
};

class SceneTriangles {
 public:
  SceneTriangles(const std::filesystem::path& glb, bool has_traffic) : file_(glb) {
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < file_.mesh_count(); ++i) counts.push_back(file_.count_triangles(i));
    std::vector<bool> skipped;
    for (const SceneNode& node : nodes()) skipped.push_back(has_traffic && node.vehicle != no_id);
    is_static_ = find_static_nodes(nodes(), counts, skipped);
    for (std::size_t i = 0; i < nodes().size(); ++i) is_static_[i] = is_static_[i] && !skipped[i];
    units_ = find_units(nodes(), file_.mesh_count());
  }

  // Gathers the triangles of static nodes in the order in which nightview stores them, and sets the
  // nodes, the number of triangles and their box.
  CutPieces gather(const BoxFrame& frame, StoredHierarchy& hierarchy) {
    PieceGatherer gatherer(count(), frame);
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      if (!is_static_[i] || nodes()[i].casts_shadow != hierarchy.casts_shadow) continue;
      const std::vector<glm::dmat4> placements = find_placements(nodes()[i]);
      if (placements.empty()) continue;
      hierarchy.nodes.push_back(nodes()[i].number);
      for_each_triangle(nodes()[i], placements,
                        [&](const Corners& triangle) { gatherer.add(triangle); });
    }
    CutPieces pieces = gatherer.take();
    hierarchy.triangles = gatherer.triangles();
    hierarchy.lower = to_vec3(gatherer.box().lower);
    hierarchy.upper = to_vec3(gatherer.box().upper);
    return pieces;
  }

  // Returns the frame of the walls, as far as some triangles of some nodes show it.
  BoxFrame find_frame() {
    constexpr std::size_t enough_nodes = 64, enough_triangles = 1 << 14;
    std::vector<std::size_t> casting;
    for (std::size_t i = 0; i < nodes().size(); ++i)
      if (is_static_[i] && nodes()[i].casts_shadow) casting.push_back(i);
    const std::size_t step = 1 + casting.size() / enough_nodes;
    WallDirections directions;
    for (std::size_t k = 0; k < casting.size(); k += step) {
      const SceneNode& node = nodes()[casting[k]];
      const std::size_t stride =
          1 + file_.count_triangles(node.mesh) * node.instances.size() / enough_triangles;
      std::size_t number = 0;
      for_each_triangle(node, find_placements(node), [&](const Corners& triangle) {
        if (number++ % stride == 0) directions.add(triangle);
      });
    }
    return directions.find_frame();
  }

  // Returns how many there are at most.
  std::size_t count() const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < nodes().size(); ++i)
      if (is_static_[i])
        sum += file_.count_triangles(nodes()[i].mesh) * nodes()[i].instances.size();
    return sum;
  }

 private:
  const std::vector<SceneNode>& nodes() const { return file_.scene().nodes; }

  std::vector<glm::dmat4> find_placements(const SceneNode& node) const {
    std::vector<glm::dmat4> placements;
    for (const SceneInstance& instance : node.instances) {
      const glm::dmat4 to_scene = to_double(instance);
      if (may_be_flat(node) || keeps_volume(to_scene, units_[node.mesh]))
        placements.push_back(to_scene);
    }
    return placements;
  }

  // Calls take(corners) with each triangle that is shown: of each primitive its copies in turn.
  template <class Take>
  void for_each_triangle(const SceneNode& node, const std::vector<glm::dmat4>& placements,
                         Take take) {
    std::vector<glm::vec3> positions;
    for (const ScenePrimitive& primitive : file_.read_mesh(node.mesh).primitives)
      for (const glm::dmat4& to_scene : placements) {
        positions.clear();
        for (const glm::vec3& p : primitive.positions) positions.push_back(place(to_scene, p));
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
          const glm::vec3 &v0 = positions[primitive.indices[i]],
                          &v1 = positions[primitive.indices[i + 1]],
                          &v2 = positions[primitive.indices[i + 2]];
          if (is_shown(v0, v1, v2)) take(Corners{to_float4(v0), to_float4(v1), to_float4(v2)});
        }
      }
  }

  SceneFile file_;
  std::vector<bool> is_static_;  // of each node
  std::vector<double> units_;    // of each mesh
};

std::optional<BuiltHierarchy> build(SceneTriangles& triangles, bool casts_shadow,
                                    const BoxFrame& frame, unsigned threads) {
  BuiltHierarchy built;
  StoredHierarchy& described = built.description;
  described.casts_shadow = casts_shadow;
  described.along = frame.along;
  CutPieces pieces = triangles.gather(frame, described);
  if (pieces.pieces.empty()) return std::nullopt;
  built.encoded = build_encoded(std::move(pieces), described.triangles, threads, described.area_m2);
  return built;
}

}  // namespace

std::vector<BuiltHierarchy> build_static_hierarchies(const std::filesystem::path& glb,
                                                     bool has_traffic, unsigned threads) {
  std::vector<BuiltHierarchy> result;
  SceneTriangles triangles(glb, has_traffic);
  if (triangles.count() > leaf_first_mask) return result;
  const BoxFrame frame = triangles.find_frame();
  for (const bool casts_shadow : {true, false})
    if (auto built = build(triangles, casts_shadow, frame, threads))
      result.push_back(std::move(*built));
  for (BuiltHierarchy& built : result) {
    built.description.topology = std::as_bytes(std::span(built.encoded.topology));
    built.description.order = std::as_bytes(std::span(built.encoded.order));
    built.description.cuts = std::as_bytes(std::span(built.encoded.cuts));
  }
  return result;
}

}  // namespace nightcity::hierarchy
