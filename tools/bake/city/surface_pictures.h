// Pictures on the triangles of an object, as large as the scene has room for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/mesh/triangle_mesh.h"

namespace nightcity::bake {

/// A piece of a picture: rows from above, sRGB, three bytes a texel.
struct PicturePiece {
  std::uint16_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(width, height, rgb);
  }
};

constexpr std::uint32_t no_piece = 0xFFFFFFFFu;
/// The piece on a triangle, and where its corners lie there, in texels from the upper left corner.
struct PicturedTriangle {
  std::uint32_t piece = no_piece;
  glm::vec2 places[3] = {};
};

/// The pictures of an object. `triangles` is parallel to its mesh's, or empty: there are none.
struct SurfacePictures {
  std::vector<PicturePiece> pieces;
  std::vector<PicturedTriangle> triangles;

  /// Passes each field to an archive.
  template <class Archive>
  void visit(Archive& archive) {
    archive(pieces, triangles);
  }
};

/// Remembers where the pictures of an object's polygons lie, before its outlines are repaired.
class PictureLayout {
 public:
  /// Coordinates are E, N, H in metres. Numbers the polygons that have a picture: several may share
  /// one (implicit geometry placed twice), and each lies elsewhere.
  explicit PictureLayout(city::CityObject& object);

  /// Returns the pictures on the triangles of the object's mesh. A picture with more texels to a
  /// metre than `texels_per_m` gets as many. The surfaces of a building that are of one kind, walls
  /// or roofs, get the same mean luminance, which theirs together have: a picture is taken by day,
  /// when some face the sun.
  SurfacePictures lay_out(const mesh::TriangleMesh& mesh, const city::CityObject& object,
                          double texels_per_m) const;
  bool empty() const { return placed_.empty(); }
  std::size_t size() const { return placed_.size(); }  // polygons

 private:
  struct Before {
    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const;
  };
  struct Placed {
    std::map<glm::dvec3, glm::dvec2, Before> places;  // of the vertices, in pixels
    // The place of a vertex that a repair has moved or added: place + across * (p - at).
    glm::dvec3 at{0}, across[2] = {};
    glm::dvec2 place{0};
    double area_m2 = 0, pixels = 0;  // of the polygon, and of the same in the picture

    glm::dvec2 find(const glm::dvec3& p) const;
  };
  static Placed to_placed(const city::Polygon& polygon);

  std::vector<Placed> placed_;  // by the polygon's number - 1
};

}  // namespace nightcity::bake
