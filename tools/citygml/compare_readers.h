// Compares what the two CityGML readers make of a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/city/city_reader.h"

namespace nightcity::citygml {

/// Counts of one kind of object or surface, by one reader.
struct ReaderTally {
  std::size_t objects = 0, polygons = 0;
  /// The area of the rings less holes, in the file's own units squared: good for
  /// comparing readers alone.
  double area = 0;
};

/// Returns whether counts are equal and areas differ by no more than rounding.
bool alike(const ReaderTally& a, const ReaderTally& b);

struct ReaderComparison {
  /// By object type and by surface type ("building", "wall", ...): first the stream reader's,
  /// second libcitygml's.
  std::map<std::string, std::pair<ReaderTally, ReaderTally>> objects, surfaces;
  std::vector<std::string> only_in_stream, only_in_libcitygml;  // ids of objects, sorted
  city::ReadReport stream, libcitygml;

  /// Returns whether ids, objects and polygons of every kind are the same,
  /// and areas but for rounding.
  bool agree() const;
};

/// Reads `file` with both readers. Throws Error as read_citygml does.
ReaderComparison compare_readers(const std::filesystem::path& file, int max_lod);

}  // namespace nightcity::citygml
