// Packed maps (PBF, o5m, XML in gzip or bzip2) as libosmium opens them.
#pragma once

#include <osmium/io/file.hpp>
#include <osmium/memory/buffer.hpp>
#include <osmium/object_pointer_collection.hpp>
#include <osmium/visitor.hpp>

#include <cstddef>
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
  SortedMap() = default;

  /// Adds the elements of another file, behind which they have to be sorted.
  void add(const std::filesystem::path& file);
  /// Puts the newest version of an element before its older ones.
  void sort_newest_first();
  auto begin() const { return objects_.cbegin(); }
  auto end() const { return objects_.cend(); }

  /// Calls the handlers of libosmium one after the other for each element, and then flushes them.
  template <class... Handlers>
  void apply_to(Handlers&&... handlers) {
    osmium::apply(objects_.begin(), objects_.end(), handlers...);
  }

 private:
  std::vector<osmium::memory::Buffer> buffers_;  // which the objects lie in
  std::size_t unpacked_ = 0;
  osmium::ObjectPointerCollection objects_;
};

}  // namespace nightcity::osm
