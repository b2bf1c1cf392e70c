// The part that all readers of city files share: options, report and the delivery of objects.
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

#include "tools/city/city_model.h"
#include "tools/city/text_pieces.h"

namespace nightcity::map_buildings {
class CityMaps;
}

namespace nightcity::city {

/// Counts of a file's content and of all that was not used. Silence means that nothing was lost.
struct ReadReport {
  std::string version;   // of the format: "1.0", "2.0", "3.0"
  std::string srs_name;  // the coordinate reference system as written; "" = none
  std::size_t objects = 0, polygons = 0;
  std::map<std::string, std::size_t> skipped;  // what, by name, and how often
  std::map<std::string, std::size_t> assumed;  // what the file does not say, and how often
  /// Files of an archive that are not read, by what they are or how their names end.
  std::map<std::string, std::size_t> passed_over;
  std::vector<std::string> warnings;  // each names file and place
  /// Buildings published as a footprint alone: made blocks of their height, and left flat for want
  /// of one.
  std::size_t extruded = 0, flat = 0;
  /// Buildings with a shape and a measured height: those as high as that, roughly, those several
  /// times as high, and those of a fraction of it.
  std::size_t as_measured = 0, above_measured = 0, below_measured = 0;
  /// Surfaces that have the mean colour of their picture, and polygons on which pictures lie.
  std::size_t coloured_by_pictures = 0, laid_out_pictures = 0;
  /// Why a piece of a file cannot be read without the rest of it; "" = it can.
  std::string needs_whole_file;

  void merge(const ReadReport& other);

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(version, srs_name, objects, polygons, skipped, assumed, passed_over, warnings, extruded,
            flat, as_measured, above_measured, below_measured, coloured_by_pictures,
            laid_out_pictures, needs_whole_file);
  }
};

/// Adds warnings for the file's buildings that were published as footprints, for heights that
/// contradict the measured ones and for pictures, and makes all texts valid UTF-8. To be called
/// once the whole file has been read, and not for each of its pieces.
void finish_report(const std::filesystem::path& file, ReadReport& report);

/// The parser of CityGML. Both deliver the same model; the second is a second opinion.
enum class Reader : std::uint8_t { stream, libcitygml };

/// The placement of a mesh says how its coordinates become metres east, north and up of the city's
/// system, in formats that state neither unit nor axes nor place (Wavefront OBJ).
struct MeshPlacement {
  enum class Up : std::uint8_t { automatic, y, z };
  Up up = Up::automatic;  // automatic: the one of y and z along which the model extends less
  double unit_m = 1;      // of the file's coordinates
  glm::dvec3 origin{0};   // of the file, in the city's system: easting, northing, height
  int max_vertices = 20'000'000;  // a limit: a vertex takes 24 bytes
};

/// Textures are left out, or each surface gets the mean colour of its own, or the picture as well.
enum class Textures : std::uint8_t { none, mean, atlas };

/// A polygon beyond these is left out and counted.
struct PolygonLimits {
  int max_crossings = 16;      // of its outlines, for each of their points
  int max_points = 2'000'000;  // of all its outlines
};

struct ReadOptions {
  /// Each object is taken at its highest LoD up to this one or, where it has none, at the lowest
  /// above.
  int max_lod = 2;
  Reader reader = Reader::stream;
  /// 0 = one per core. The objects and their order do not depend on it.
  unsigned threads = 0;
  /// The files of the same city, lexically normal: links to geometry lead into these and no others.
  std::shared_ptr<const std::set<std::filesystem::path>> neighbours{};
  /// The name of the CRS that the caller takes the file's coordinates by (CityHead::srs_name).
  /// Polygons of other names carry theirs. Absent: names are not looked at.
  std::optional<std::string> srs_name{};
  double height_unit_m = 1;  // metres in the unit of the file's heights, which its CRS says
  MeshPlacement mesh{};
  Textures textures = Textures::none;
  /// Bounds on what a small file may cost; the recipe's keys of the same names raise them.
  int max_member_mb = 256;              // of text in one member of a CityModel, or city object
  int max_linked_vertices = 8'000'000;  // that the links of a document lead to, and of a member's
  PolygonLimits polygon{};
  int max_way_nodes = 20'000;  // of a building in a map, over all ways of its outline
  bool map_colours = true;     // of a map's buildings: by their tags
  /// All maps of the city, of which a file that is read may be one: a building at the edge of one
  /// may have parts that only another has. Null: it is alone.
  std::shared_ptr<map_buildings::CityMaps> maps{};
  /// Read this piece alone, of a file that FileReader::find_cuts allows to be cut.
  std::optional<TextPiece> piece{};

  /// Returns whether objects are to go through the stage one at a time: with cut-out pictures each
  /// may have cut_picture.h's max_object_pixels, and several threads have many objects on the way.
  bool passes_one_by_one() const { return textures == Textures::atlas; }

  std::size_t max_member_bytes() const { return static_cast<std::size_t>(max_member_mb) << 20; }
};

/// Called on one thread at a time, in file order; objects that refer to geometry of other objects
/// come after all others. An object too large for one piece (a terrain of millions of triangles)
/// comes in several calls, one after the other, with the same id.
using ObjectSink = std::function<void(CityObject&&)>;

/// Work on objects that would hold up the reading: called on many threads at once, each time with
/// some objects in file order. What it returns is then called on one thread at a time, in file
/// order.
using ObjectStage = std::function<std::function<void()>(std::vector<CityObject>&&)>;

/// Returns a stage that only passes objects on to `sink`, which must outlive it.
ObjectStage deliver_to(const ObjectSink& sink);

/// The facts that a frame needs before the first object is placed, from a cheap look
/// at the file's beginning.
struct CityHead {
  std::string version;   // of the format; "" = the file does not say
  std::string srs_name;  // of the first rings, as written; "" = the file names none
  /// Vertices of the first rings of that CRS, as written; empty = a file without geometry.
  std::vector<glm::dvec3> sample;
  std::set<std::string> linked_files;  // that geometry is linked from, as written

  /// Passes each field to an archive (tools/archive.h).
  template <class Archive>
  void visit(Archive& archive) {
    archive(version, srs_name, sample, linked_files);
  }
};

/// A format's reader. Both functions throw Error: the file is missing, empty, broken or of another
/// format.
struct FileReader {
  /// Reads until it has a sample or the file ends.
  CityHead (*read_head)(const std::filesystem::path& file, const ReadOptions& options);
  /// Streams the objects through `stage` in file order, in memory that does not grow with the file.
  ReadReport (*read)(const std::filesystem::path& file, const ReadOptions& options,
                     const ObjectStage& stage);
  /// Returns how the file may be cut into pieces, each to be read by itself; nothing where it has
  /// to be read whole. Null: no file of the format can be cut.
  std::optional<FileCuts> (*find_cuts)(const std::filesystem::path& file) = nullptr;
};

}  // namespace nightcity::city
