// Turns GML geometry of any nesting into polygons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tools/city/cut_picture.h"
#include "tools/city/merge_parts.h"
#include "tools/city/skip_counter.h"
#include "tools/citygml/appearances.h"
#include "tools/citygml/srs_scope.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {

/// Returns the number of polygons (gml:Polygon, PolygonPatch, Triangle, Rectangle) in an element
/// and below.
std::size_t count_polygons(const pugi::xml_node& element);

/// The properties that elements further up give to the geometry below them.
struct GeometryContext {
  int lod = -1;
  std::uint32_t space = 0;
  city::SurfaceType surface = city::SurfaceType::unknown;
  std::uint16_t area_function = 0;     // of the traffic area
  int dimension = 0;                   // srsDimension given further up; 0 = none
  bool reversed = false;               // below an OrientableSurface '-'
  int depth = 0;                       // of elements and links, from the member
  int links = 0;                       // xlinks followed on the way here
  const glm::vec3* colour = nullptr;   // of a material further up
  const glm::dmat4* placed = nullptr;  // transformation of an implicit geometry
  const glm::dvec3* anchor = nullptr;  // and its reference point
  SrsName srs_name{};                  // of the coordinates
};

/// Elements nested deeper than this are skipped and counted: no CityGML needs it, and the stack is
/// finite.
constexpr int max_nesting = 200;

class GeometryWalk {
 public:
  GeometryWalk(const pugi::xml_node& member, const GeometryLibrary& library,
               city::SkipCounter& skipped)
      : ids_(member), library_(library), skipped_(skipped) {}

  /// Adds every polygon below `property` (lod2Solid, tin, ...) to `out` and counts what cannot be
  /// used. A polygon reached twice (a solid's xlink to a wall) is added once.
  void read(const pugi::xml_node& property, const GeometryContext& context, city::RawPolygons& out);
  /// The same for a geometry element itself.
  void read_element(const pugi::xml_node& geometry, const GeometryContext& context,
                    city::RawPolygons& out);
  /// Adds every vertex below `property` to the object: break lines to its `lines`, single vertices
  /// to its `points`. Those of another CRS than the first are skipped and counted.
  void read_points(const pugi::xml_node& property, const GeometryContext& context,
                   city::CityObject& object);

  /// The same for the control points and break lines of a gml:Tin that has no triangles: by GML
  /// 3.1.1, 10.5.14, these define its surface. Returns false where the property holds no such Tin.
  bool read_tin_points(const pugi::xml_node& property, const GeometryContext& context,
                       city::CityObject& object);

  /// Gives the places of points and of implicit geometries to the `points` of `plant` from now on;
  /// null: to nobody. The place of an implicit geometry is where it puts the origin of its shape.
  void set_plant(city::CityObject* plant) { plant_ = plant; }

  Materials& local_materials() { return local_materials_; }
  void set_file_materials(const Materials* materials) { file_materials_ = materials; }
  /// Looks at the names of CRSs in the member from now on; `scope` must outlive the walk.
  void set_srs_scope(SrsScope* scope) { srs_scope_ = scope; }
  /// Returns the name that the element gives to its geometry, or the one given to it.
  SrsName find_srs_name_in(const pugi::xml_node& feature, const SrsName& inherited) const;
  /// Ids named by xlinks that neither the member nor the library holds.
  const std::vector<std::string>& unresolved() const { return unresolved_; }
  /// The numbers of the library's polygons among those added, by their place in `out` (only where
  /// `out` was empty and every call had the same); 0 = the member's own.
  const std::vector<std::uint64_t>& linked_numbers() const { return linked_numbers_; }
  /// Returns whether a member links to more polygons of the library than it may take.
  bool took_too_many() const { return linked_vertices_ > library_.max_vertices; }

 private:
  void walk(const pugi::xml_node& element, const GeometryContext& context);
  void walk_children(const pugi::xml_node& element, const GeometryContext& context);
  void follow(const pugi::xml_node& link, std::string_view href, const GeometryContext& context);
  void read_polygon(const pugi::xml_node& element, const GeometryContext& context);
  void read_implicit(const pugi::xml_node& element, const GeometryContext& context);
  void add_place(const glm::dvec3& place, const SrsName& srs_name);
  void add(city::Polygon&& polygon, const GeometryContext& context);
  struct Points {
    std::vector<glm::dvec3>& points;
    std::vector<city::Ring>& lines;
    std::optional<SrsName> srs_name{};  // of the first one
  };
  void walk_points(const pugi::xml_node& property, const GeometryContext& context, Points& out);
  const glm::vec3* find_colour(const pugi::xml_node& element) const;
  const RingTexture* find_ring_texture(const pugi::xml_node& ring) const;
  void take_srs_name_of(const pugi::xml_node& element, GeometryContext& context) const;
  void take_own_srs_name(const pugi::xml_node& element, GeometryContext& context) const;

  void add_linked(const std::vector<LinkedPolygon>& linked, const GeometryContext& context);

  struct Visit {
    std::uintptr_t element;
    int lod;
    bool operator==(const Visit&) const = default;
  };
  static Visit visit_of(const pugi::xml_node& element, const GeometryContext& context);
  struct VisitHash {
    std::size_t operator()(const Visit& v) const {
      return std::hash<std::uintptr_t>()(v.element) * 31 + static_cast<std::size_t>(v.lod + 1);
    }
  };

  IdIndex ids_;
  const GeometryLibrary& library_;
  city::SkipCounter& skipped_;
  Materials local_materials_;
  const Materials* file_materials_ = nullptr;
  SrsScope* srs_scope_ = nullptr;  // null: the member names no CRS
  city::RawPolygons* out_ = nullptr;
  city::CityObject* plant_ = nullptr;
  using Visits = std::unordered_set<Visit, VisitHash>;
  Visits visited_;  // elements of this member
  Visits linked_;   // polygons of the library, by number
  std::vector<std::uint64_t> linked_numbers_;
  std::size_t linked_vertices_ = 0;
  std::vector<std::string> unresolved_;
  std::size_t placed_polygons_ = 0;
  std::int64_t pixels_left_ = city::max_object_pixels;  // of pictures on the member's polygons
};

}  // namespace nightcity::citygml
