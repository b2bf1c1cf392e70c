// The second pass over an OBJ: its faces, object by object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/city_model.h"
#include "tools/city/skip_counter.h"
#include "tools/obj/materials.h"
#include "tools/obj/text_lines.h"
#include "tools/obj/vertices.h"

namespace nightcity::obj {

constexpr std::uint32_t no_place = 0xFFFFFFFFu;

/// The faces of one object: `corners` holds the vertices of all of them, one face after the other.
struct Faces {
  std::string name;                        // "" = the file names none
  bool continued = false;                  // a later piece of the object before it
  std::vector<std::uint32_t> corners;      // numbers of vertices
  std::vector<std::uint32_t> places;       // in pictures, of each corner; empty: they are not read
  std::vector<std::uint32_t> ends;         // of each face in `corners`
  std::vector<const Material*> materials;  // of each face; null: none
  std::vector<city::ObjectType> kinds;     // of each face, by the name of its material

  std::size_t size() const { return ends.size(); }
  void add(const Faces& other, std::size_t face);
  /// Returns what the names of all materials say that it is: building where they differ.
  city::ObjectType find_common_kind() const;
};

class GroupReader {
 public:
  /// `vertices` must outlive the reader and what it returns refers to `materials` in it.
  GroupReader(const city::Document& document, const Vertices& vertices);

  /// Returns the next object that has faces, in the order of the file; a large one in pieces. None
  /// at the end. Throws Error with the line where a face refers to no vertex.
  std::optional<Faces> next();

  const city::SkipCounter& skipped() const { return skipped_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Returns the number of faces that were given out.
  std::size_t faces() const { return faces_; }

 private:
  bool begins_object(std::string_view key) const;
  void read_face(std::string_view rest);
  void read_library(std::string_view names);
  std::uint32_t to_vertex(std::string_view word) const;
  std::uint32_t to_texture_place(std::string_view word) const;
  void take_statement(std::string_view key, std::string_view rest);
  Faces give(bool goes_on);

  const Vertices& vertices_;
  TextLines lines_;
  std::filesystem::path folder_of_;  // the OBJ, beside which its libraries lie; empty: packed
  // Each library once. Faces that are worked on elsewhere refer to its materials, so these stay as
  // they are when a later one has the same names.
  std::map<std::filesystem::path, std::map<std::string, Material>> libraries_;
  std::map<std::string, const Material*> materials_;  // the latest of each name
  const Material* material_ = nullptr;
  city::ObjectType kind_ = city::ObjectType::building;  // by the name of the material
  std::size_t seen_vertices_ = 0, seen_texture_places_ = 0, faces_ = 0;
  Faces current_;
  bool goes_on_ = false;  // a piece of the current object has been given out
  bool is_over_ = false;
  city::SkipCounter skipped_;
  std::vector<std::string> warnings_;
};

/// Cuts faces of which the file names no parts into those that hang together: two faces that have a
/// place in common belong to one object, and, where nothing has a name, only if their materials
/// name one kind. By their kind, then in the order of their first faces. A single one has the name
/// in `faces`, each of several a name of its own by its shape.
std::vector<Faces> split_by_connection(const Faces& faces, const Vertices& vertices);

}  // namespace nightcity::obj
