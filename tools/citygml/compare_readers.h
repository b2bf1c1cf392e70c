// Where the two readers disagree on a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/city/city_reader.h"

namespace nightcity {

/// What a reader made of one kind of thing.
struct ReaderTally {
  std::size_t objects = 0, polygons = 0;
  double area =
      0;  // of the rings, holes subtracted, in the file's own units squared: for comparing, not for stating
};

/// The same counts, and areas that differ by no more than rounding.
bool alike(const ReaderTally& a, const ReaderTally& b);

struct ReaderComparison {
  /// By object type and by surface type ("building", "wall", ...): first the stream reader, second
  /// libcitygml.
  std::map<std::string, std::pair<ReaderTally, ReaderTally>> objects, surfaces;
  std::vector<std::string> only_in_stream, only_in_libcitygml;  // ids of objects, sorted
  ReadReport stream, libcitygml;

  /// No difference in objects or polygons of any kind, nor beyond rounding in areas.
  bool agree() const;
};

/// Reads `file` with both. Throws Error as read_citygml does.
ReaderComparison compare_readers(const std::filesystem::path& file, int highest_lod);

}  // namespace nightcity
