// The first pass over an OBJ: its vertices, and what its objects are called by.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::obj {

/// The faces of a file are grouped to city objects in one of these ways.
enum class Grouping : std::uint8_t {
  by_object,     // statements `o`
  by_group,      // statements `g`, where there is one `o` or none
  by_connection  // the file names no parts: faces that share places belong together
};

struct Vertices {
  std::vector<glm::dvec3> places;  // E, N, H by the options
  /// In pictures, from the lower left corner (vt), and what the file says of libraries of colours
  /// (mtllib): where the options have textures read.
  std::vector<glm::vec2> texture_places;
  std::vector<std::string> libraries;
  bool keeps_texture_places = false;
  Grouping grouping = Grouping::by_connection;
  bool y_up = false;       // which axis of the file points up
  bool up_is_said = true;  // by the options; else it was taken from the extents
};

/// Reads all vertices. `most`: stop at this many (0: none), then the grouping is not known. Throws
/// Error with the line: a vertex of fewer than three numbers, more of them than
/// ReadOptions::mesh allows.
Vertices read_vertices(const city::Document& document, const city::ReadOptions& options,
                       std::size_t most = 0);

}  // namespace nightcity::obj
