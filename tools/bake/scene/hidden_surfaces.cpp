#include "tools/bake/scene/hidden_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <unordered_map>
#include <utility>

#include "tools/bake/scene/drape.h"

namespace nightcity::bake {
namespace {

constexpr double together_m = 0.01;     // two surfaces that are less than this apart touch
constexpr double max_facing = -0.9998;  // cosine between their normals: opposite within a degree
constexpr double min_face_area_m2 = 1e-4;
constexpr double uncovered = 1e-3;  // share of a triangle that rounding may leave open
constexpr double cell_m = 4;
constexpr double sample_every_m = 5;

using Outline = std::vector<glm::dvec2>;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double area(const Outline& outline) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < outline.size(); ++k)
    twice += cross(outline[k] - outline[0], outline[k + 1] - outline[0]);
  return twice / 2;
}

// Returns the part of a convex outline to the left of the line a-b (Sutherland and Hodgman 1974).
Outline clip_left_of(const Outline& outline, const glm::dvec2& a, const glm::dvec2& b) {
  Outline result;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const glm::dvec2 &p = outline[k], &q = outline[(k + 1) % outline.size()];
    const double side_p = cross(b - a, p - a), side_q = cross(b - a, q - a);
    if (side_p >= 0) result.push_back(p);
    if ((side_p >= 0) != (side_q >= 0))
      result.push_back(p + (q - p) * (side_p / (side_p - side_q)));
  }
  return result;
}

struct Face {
  glm::dvec3 corners[3], normal;
  double area;
};

class Search {
 public:
  explicit Search(std::span<const TileStore::StoredTriangle> triangles) : triangles_(triangles) {
    faces_.resize(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      if (!triangles[i].solid) continue;
      Face& face = faces_[i];
      for (int k = 0; k < 3; ++k) face.corners[k] = glm::dvec3(triangles[i].corners[k]);
      const glm::dvec3 twice =
          glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
      face.area = glm::length(twice) / 2;
      if (!(face.area > min_face_area_m2)) continue;
      face.normal = twice / (2 * face.area);
      each_cell(face, [&](std::uint64_t cell) { cells_[cell].push_back(i); });
    }
  }

  bool is_covered(std::uint32_t i) const {
    const Face& face = faces_[i];
    if (!triangles_[i].solid || !(face.area > min_face_area_m2)) return false;
    std::vector<std::uint32_t> near;
    each_cell(face, [&](std::uint64_t cell) {
      const auto found = cells_.find(cell);
      if (found != cells_.end())
        near.insert(near.end(), found->second.begin(), found->second.end());
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::map<std::uint32_t, double> by_feature;  // a solid's surfaces do not lie on each other
    for (const std::uint32_t other : near)
      if (triangles_[other].feature != triangles_[i].feature && touches(face, faces_[other]))
        by_feature[triangles_[other].feature] += overlap(face, faces_[other]);
    return std::any_of(by_feature.begin(), by_feature.end(), [&](const auto& part) {
      return part.second >= (1 - uncovered) * face.area;
    });
  }

 private:
  template <class Visit>
  static void each_cell(const Face& face, const Visit& visit) {
    const glm::dvec3 low = glm::min(glm::min(face.corners[0], face.corners[1]), face.corners[2]) -
                           together_m,
                     high = glm::max(glm::max(face.corners[0], face.corners[1]), face.corners[2]) +
                            together_m;
    const auto cell = [](double v) { return static_cast<std::int32_t>(std::floor(v / cell_m)); };
    for (std::int32_t x = cell(low.x); x <= cell(high.x); ++x)
      for (std::int32_t z = cell(low.z); z <= cell(high.z); ++z)
        visit(static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 |
              static_cast<std::uint32_t>(z));
  }

  static bool touches(const Face& a, const Face& b) {
    if (glm::dot(a.normal, b.normal) > max_facing) return false;
    for (const glm::dvec3& p : b.corners)
      if (std::abs(glm::dot(a.normal, p - a.corners[0])) > together_m) return false;
    return true;
  }

  // Returns the area that two faces in one plane have in common.
  static double overlap(const Face& a, const Face& b) {
    const glm::dvec3 u = glm::normalize(a.corners[1] - a.corners[0]), v = glm::cross(a.normal, u);
    const auto flat = [&](const glm::dvec3& p) {
      return glm::dvec2(glm::dot(p - a.corners[0], u), glm::dot(p - a.corners[0], v));
    };
    Outline common{flat(b.corners[2]), flat(b.corners[1]),
                   flat(b.corners[0])};  // b faces the other way
    for (int k = 0; k < 3 && !common.empty(); ++k)
      common = clip_left_of(common, flat(a.corners[k]), flat(a.corners[(k + 1) % 3]));
    return common.size() < 3 ? 0 : area(common);
  }

  std::span<const TileStore::StoredTriangle> triangles_;
  std::vector<Face> faces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

// The triangles have model axes, where y is the height; subdivide() takes E, N, H and cuts in plan.
bool is_all_below(const TileStore::StoredTriangle& triangle, const BelowGround& below) {
  for (const glm::vec3& corner : triangle.corners)
    if (!below(corner)) return false;  // for most triangles the first corner decides
  glm::dvec3 corners[3];
  for (int k = 0; k < 3; ++k) {
    const glm::vec3& p = triangle.corners[k];
    corners[k] = glm::dvec3(p.x, p.z, p.y);
  }
  bool all = true;
  subdivide(corners, sample_every_m, [&](const glm::dvec3(&piece)[3]) {
    const glm::dvec3 middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    for (const glm::dvec3& p : {piece[0], piece[1], piece[2], middle})
      all = all && below(glm::vec3(glm::dvec3(p.x, p.z, p.y)));
  });
  return all;
}

}  // namespace

std::vector<bool> find_hidden_triangles(std::span<const TileStore::StoredTriangle> triangles,
                                        const BelowGround& below, HiddenCounts& counts) {
  const Search search(triangles);
  std::vector<bool> hidden(triangles.size(), false);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (!triangles[i].solid) continue;
    const bool between = search.is_covered(i);
    hidden[i] = between || is_all_below(triangles[i], below);
    counts.between += between;
    counts.below += hidden[i] && !between;
  }
  return hidden;
}

}  // namespace nightcity::bake
