// Maps that are read by another file: in an archive, as sites of extracts and mail programs pack
// them, in a stream that their readers do not know (xz, ...), and in JSON.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "formats/error.h"
#include "formats/scratch_file.h"

namespace nightcity::osm {

/// A map where the readers of this folder find it: where it lies, or in a file without a name, to
/// which it was unpacked, or translated from JSON to XML.
class MapFile {
 public:
  /// Throws Error where `file` is an archive that holds no map or several, or is broken, or is
  /// broken JSON. Of other files the beginning is looked at. What was unpacked last is kept, as a
  /// bake reads a map several times.
  explicit MapFile(const std::filesystem::path& file);

  /// Returns the path to read from, as long as this object is there.
  const std::filesystem::path& path() const { return path_; }
  /// Returns an error of a reader with the map's name in place of that path.
  Error to_named(const Error& error) const;

 private:
  std::filesystem::path path_;
  std::string name_;
  std::shared_ptr<ScratchFile> unpacked_;  // null: the file itself
};

/// From now on MapFile finds these bytes in place of a file's, as long as somebody keeps them.
void set_stand_in(const std::filesystem::path& file, const std::shared_ptr<ScratchFile>& bytes);

/// Returns what `work` makes of the path at which a map lies plain or as one of OSM's packed
/// formats. Errors name the map.
template <class Work>
auto read_map_file(const std::filesystem::path& file, const Work& work) {
  const MapFile map(file);
  try {
    return work(map.path());
  } catch (const Error& error) {
    throw map.to_named(error);
  }
}

/// The endings of names of maps in an archive, in lower case. (.osm.gz is read under its name
/// without .gz.)
inline constexpr std::array<std::string_view, 3> map_endings{".osm", ".pbf", ".o5m"};

}  // namespace nightcity::osm
