// Turns the geometries of a city object into polygons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/city/cut_picture.h"
#include "tools/city/merge_parts.h"
#include "tools/city/skip_counter.h"
#include "tools/cityjson/shared_parts.h"

namespace nightcity::cityjson {

/// The vertices, templates and materials that geometries refer to by number.
struct GeometrySources {
  std::span<const glm::dvec3> vertices;  // in the city's CRS
  bool all_usable = false;               // the vertices; false: each polygon's are looked at
  const SharedParts* shared = nullptr;
  const Materials* materials = nullptr;  // of the document, or of the feature's own appearance
};

class GeometryReader {
 public:
  GeometryReader(const GeometrySources& sources, city::SkipCounter& skipped)
      : sources_(sources), skipped_(skipped) {}

  /// Adds the places of points and of templates to `places` from now on; null: nowhere. The place
  /// of a template is where its origin comes to lie.
  void set_places(std::vector<glm::dvec3>* places) { places_ = places; }

  /// Adds every polygon of a city object's "geometry" to `out`. Of several refined levels of detail
  /// of one level (1.2 and 1.3) the finest is taken. `surface`: of polygons without semantics.
  /// Counts what cannot be used.
  void read(const dom::array& geometries, std::uint32_t space, city::SurfaceType surface,
            city::RawPolygons& out);

 private:
  // A polygon's semantic surface.
  struct Semantics {
    city::SurfaceType surface = city::SurfaceType::unknown;
    std::uint16_t area_function = 0;
    bool interior = false;
  };
  struct Context {
    std::span<const glm::dvec3> vertices;
    int lod = -1;
    std::uint32_t space = 0;
    city::SurfaceType surface = city::SurfaceType::unknown;
    std::vector<Semantics> semantics;
    const glm::vec3* colour = nullptr;  // of the whole geometry
  };
  // These belong to a surface, or to those below a level of "boundaries"; null: there are none.
  struct Beside {
    const dom::element *semantics = nullptr, *material = nullptr, *texture = nullptr;
  };

  void read_geometry(const dom::object& geometry, Context context, city::RawPolygons& out);
  void read_instance(const dom::object& geometry, const Context& context, city::RawPolygons& out);
  /// Returns where the geometry puts its template, and its reference point in `anchor`; none, and
  /// counted, where it does not say.
  std::optional<glm::dmat4> read_placement(const dom::object& geometry, glm::dvec3& anchor);
  void read_points(const dom::element& boundaries);
  void read_semantics(const dom::object& geometry, Context& context);
  const glm::vec3* find_colour(const dom::element& index) const;
  void walk(const dom::element& boundaries, const Beside& beside, int depth, const Context& context,
            city::RawPolygons& out);
  void read_surface(const dom::element& rings, const Beside& beside, const Context& context,
                    city::RawPolygons& out);
  /// Returns whether the polygon can be used; counts why it cannot.
  bool read_polygon(const dom::element& rings, const Beside& beside, const Context& context,
                    city::Polygon& polygon);
  /// Returns the values of a geometry's textures, in the default theme or else its first.
  std::optional<dom::element> find_texture_values(const dom::object& geometry);
  /// Gives the polygon its picture and the mean colour of that; counts why it has none.
  void read_texture(const dom::element& rings, city::Polygon& polygon);
  bool skip(std::string_view reason);  // counts it and returns false
  /// Returns why the ring cannot be used, null where it can.
  const char* read_ring(const dom::element& indices, std::span<const glm::dvec3> vertices,
                        bool all_usable, city::Ring& ring) const;

  GeometrySources sources_;
  city::SkipCounter& skipped_;
  std::vector<glm::dvec3>* places_ = nullptr;
  std::size_t placed_polygons_ = 0;                     // of templates, by this object
  std::int64_t pixels_left_ = city::max_object_pixels;  // of pictures on the object's polygons
};

/// Returns whether every vertex is finite and at a height that stands for no other.
bool are_usable(std::span<const glm::dvec3> vertices);

/// Returns the number of polygons in a city object's "geometry".
std::size_t count_polygons(const dom::array& geometries);

/// Adds the vertex numbers of each ring below `boundaries`, whatever kind of geometry it is.
void list_rings(const dom::element& boundaries, std::vector<std::vector<std::size_t>>& rings);

}  // namespace nightcity::cityjson
