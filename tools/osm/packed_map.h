// Packed maps (PBF, o5m, XML in gzip or bzip2) as libosmium opens them.
#pragma once

#include <osmium/io/file.hpp>
#include <osmium/memory/buffer.hpp>
#include <osmium/object_pointer_collection.hpp>
#include <osmium/visitor.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace nightcity::osm {

/// Returns the file with libosmium's name for its format, which its first bytes tell. Throws Error
/// where it is empty or cannot be read.
osmium::io::File open_packed_map(const std::filesystem::path& file);
/// The same for a format that is known: "pbf", "osm.gz", "osm.bz2", "o5m" or "osm". A Reader of it
/// leaves no descriptor open, however broken the file is.
osmium::io::File open_packed_map(const std::filesystem::path& file, const std::string& format);

/// The elements of a map in the usual order (nodes, ways, relations, each by id) although its file
/// has them in another one. All of it is in memory; throws Error where the file is too large for
/// that, and libosmium's exceptions where it is broken.
class SortedMap {
 public:
  explicit SortedMap(const std::filesystem::path& file);

  /// Calls the handlers of libosmium one after the other for each element, and then flushes them.
  template <class... Handlers>
  void apply_to(Handlers&&... handlers) {
    osmium::apply(objects_.begin(), objects_.end(), handlers...);
  }

 private:
  std::vector<osmium::memory::Buffer> buffers_;  // which the objects lie in
  osmium::ObjectPointerCollection objects_;
};

}  // namespace nightcity::osm
