// What a CityGML reader delivers, whatever parses the file: city objects with their polygons in source
// coordinates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace nightcity {

/// Coordinates as the file has them (axis order too), double. Not closed: the last vertex differs from the
/// first.
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

struct Polygon {
  std::string id;  // gml:id; "" = none
  SurfaceType surface = SurfaceType::unknown;
  Ring exterior;
  std::vector<Ring> interiors;
  std::optional<glm::vec3> diffuse_colour;  // X3DMaterial, sRGB as in the file
  std::uint16_t area_function = 0;  // code of the traffic area it lies in; 0 = none, or no number
};

/// A top-level city object with its parts and installations folded in: each building is one object.
struct CityObject {
  std::string id;  // gml:id, or a stable substitute
  ObjectType type = ObjectType::other;
  std::string class_name;  // CityGML element name: "Building", "TINRelief", ...
  std::string function, usage, building_class, address, year;  // "" = absent
  std::optional<double> measured_height_m;                     // sentinels (9999, -9999) are absent
  std::optional<int> storeys_above_ground;
  std::vector<double> storey_heights_m;
  int lod = -1;
  std::vector<Polygon> polygons;
  std::vector<glm::dvec3> points;  // relief given as mass points: for a surface through them
  std::vector<Ring> lines;         // its break lines and ridges, open: edges of that surface
};

/// What a file held and what was not used of it. Silence means that nothing was lost.
struct ReadReport {
  std::string version;   // "1.0", "2.0", "3.0"
  std::string srs_name;  // as written; "" = none
  std::size_t objects = 0, polygons = 0;
  std::map<std::string, std::size_t> skipped;  // what, by name, and how often
  std::vector<std::string> warnings;           // each names file and place

  void merge(const ReadReport& other);
};

/// Which parser stands behind read_citygml. Both deliver the same model; the second is a second opinion.
enum class Reader : std::uint8_t { stream, libcitygml };

struct ReadOptions {
  int highest_lod =
      2;  // the highest LoD up to this is taken per object, falling back to lower ones
  Reader reader = Reader::stream;
  unsigned threads =
      0;  // 0 = as many as there are cores; the objects and their order do not depend on it
  /// Files of the same city, in normal form: xlinks to geometry lead into these and no others.
  std::shared_ptr<const std::set<std::filesystem::path>> neighbours{};
};

/// Called on one thread at a time, in file order; objects that refer to geometry of other members come behind
/// all others. An object too large for one piece (a terrain of millions of triangles) comes in several calls,
/// one after the other, with the same id.
using ObjectSink = std::function<void(CityObject&&)>;

/// For work on objects that would hold up the reading: called on many threads at once, each time with some
/// objects in file order. What it returns is then called on one thread at a time, in file order.
using ObjectStage = std::function<std::function<void()>(std::vector<CityObject>&&)>;

/// What a frame needs before the first object is placed: a cheap look at the file's beginning.
struct CityGmlHead {
  std::string version;   // "1.0", "2.0", "3.0"; "" = not said
  std::string srs_name;  // first one in the file, as written; "" = none
  std::vector<glm::dvec3>
      sample;  // of its first rings, as written; empty = a file without geometry
};

/// "Building", "wall", ...: the names used in reports.
const char* name_of(ObjectType type);
const char* name_of(SurfaceType type);

/// Streams the file's objects into `sink`, in file order. Memory does not grow with the file beyond the
/// reader's own. Throws Error: missing, empty, truncated, not XML, not CityGML, DOCTYPE.
ReadReport read_citygml(const std::filesystem::path& file, const ReadOptions& options,
                        const ObjectSink& sink);

/// The same for a stage of work.
ReadReport read_citygml_staged(const std::filesystem::path& file, const ReadOptions& options,
                               const ObjectStage& stage);

/// Reads until it has a sample or the file ends. Throws Error as read_citygml does.
CityGmlHead read_citygml_head(const std::filesystem::path& file);

}  // namespace nightcity
