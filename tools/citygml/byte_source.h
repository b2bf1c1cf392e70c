// The bytes of a CityGML document, whether it lies plain, gzipped or in a zip archive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace nightcity {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Up to `size` bytes into `out`; 0 at the end. Throws Error when the file cannot be read or decompressed.
  virtual std::size_t read(char* out, std::size_t size) = 0;
};

/// Calls `use` for every document in `file`, in order: one for a plain or gzipped file, one for each .gml,
/// .xml or .citygml in a zip archive. `name` is the file's path, with the entry's name behind it in an
/// archive. Throws Error when the file is missing, empty, unreadable or an archive without documents.
void for_each_document(const std::filesystem::path& file,
                       const std::function<void(ByteSource& source, const std::string& name)>& use);

}  // namespace nightcity
