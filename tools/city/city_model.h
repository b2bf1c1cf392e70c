// The city model that every reader delivers and every stage takes, whatever format the file has.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::city {

/// A closed polygon's vertices, with the closing one left out: the last differs from the first.
/// Coordinates as in the file, its axis order too, until a frame turns them into E, N, H in metres.
using Ring = std::vector<glm::dvec3>;

enum class SurfaceType : std::uint8_t {
  unknown,
  wall,
  roof,
  ground,
  closure,
  outer_ceiling,
  outer_floor,
  window,
  door,
  traffic_area,
  auxiliary_traffic_area,
  terrain,
  water
};

enum class ObjectType : std::uint8_t {
  building,
  bridge,
  tunnel,
  relief,
  road,
  railway,
  water,
  vegetation,
  furniture,
  land_use,
  generic,
  other
};

/// The part of a picture that lies on a polygon.
struct SurfacePicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // rows from above, sRGB, three bytes a pixel
  /// The places of the vertices in it, in pixels from its upper left corner: those of the exterior
  /// come first, then those of each interior.
  std::vector<glm::dvec2> places;
};

struct Polygon {
  std::string id;  // as in the file; "" = none
  SurfaceType surface = SurfaceType::unknown;
  Ring exterior;
  std::vector<Ring> interiors;
  std::optional<glm::vec3> diffuse_colour;  // sRGB as in the file
  /// Code of the traffic area that the polygon lies in; 0 = none, or the file's code is no number.
  std::uint16_t area_function = 0;
  /// Tells polygons with a picture apart while an object is prepared (PictureLayout); 0: none.
  std::uint32_t picture_number = 0;
  /// The coordinate reference system that the polygon's coordinates have, where it is another than
  /// ReadOptions::srs_name; null elsewhere.
  std::shared_ptr<const std::string> srs_name{};
  /// The reference point of a shape that is placed by one (an implicit geometry): `exterior` and
  /// `interiors` are this and the shape's own coordinates added to it, which are metres.
  std::optional<glm::dvec3> anchor{};
  std::shared_ptr<const SurfacePicture> picture{};  // with Textures::atlas

  /// Passes each field to an archive (tools/archive.h), but for the name of a CRS and the anchor,
  /// since coordinates have the city's there, and for the picture, which then is of triangles.
  template <class Archive>
  void visit(Archive& archive) {
    archive(id, surface, exterior, interiors, diffuse_colour, area_function);
  }
};

/// A plant that stands alone (CityGML's SolitaryVegetationObject), or a cover of plants: what its
/// attributes say. Lengths in m; absent where the file does not say.
struct Plant {
  std::optional<double> height_m, crown_m, trunk_m;  // crown and trunk: diameters
  std::string species;
  int odd_sizes = 0;  // that the file gives and that no plant has: they are not used

  /// Passes each field to an archive, as Polygon's does.
  template <class Archive>
  void visit(Archive& archive) {
    archive(height_m, crown_m, trunk_m, species, odd_sizes);
  }
};

/// A top-level city object with the geometry of its parts and installations: each building is one
/// object.
struct CityObject {
  std::string id;  // as in the file, or a stable substitute
  ObjectType type = ObjectType::other;
  std::string class_name;  // the format's own name for it: "Building", "TINRelief", ...
  std::string function, usage, building_class, address, year;  // "" = absent
  std::optional<double> measured_height_m;                     // absent for 9999 and the like
  std::optional<int> storeys_above_ground;
  std::vector<double> storey_heights_m;
  int lod = -1;            // level of detail; -1 = the file does not say
  bool of_map = false;     // a building of OpenStreetMap, and not of a city model
  bool continues = false;  // a further piece of the object before it, under its id
  /// Ids of objects in other documents that it links to as its parts, and now holds.
  std::vector<std::string> joined_ids;
  std::optional<Plant> plant;  // of vegetation
  std::vector<Polygon> polygons;
  /// Mass points of a relief, whose surface goes through them; of a plant, where it stands.
  std::vector<glm::dvec3> points;
  std::vector<Ring> lines;  // its break lines and ridges, open: edges of that surface
  std::shared_ptr<const std::string> points_srs_name{};  // of points and lines, as Polygon's

  /// Passes each field to an archive, as Polygon's does.
  template <class Archive>
  void visit(Archive& archive) {
    archive(id, type, class_name, function, usage, building_class, address, year, measured_height_m,
            storeys_above_ground, storey_heights_m, lod, of_map, continues, joined_ids, plant,
            polygons, points, lines);
  }
};

/// "building", "wall", ...: the names used in reports.
const char* name_of(ObjectType type);
const char* name_of(SurfaceType type);

}  // namespace nightcity::city
