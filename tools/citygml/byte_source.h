// The bytes of a CityGML document, whether it lies plain, gzipped or in a zip archive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Up to `size` bytes into `out`; 0 at the end. Throws Error when the file cannot be read or decompressed.
  virtual std::size_t read(char* out, std::size_t size) = 0;
};

/// One CityGML document, to be read as often as needed.
struct Document {
  std::string name;  // the file's path, with the entry's name behind it in an archive
  std::function<std::unique_ptr<ByteSource>()> open;
};

/// Whether the document's bytes hold this text, wherever. Goes through all of it once: a fiftieth of the time
/// of reading it, of a compressed document a quarter.
bool mentions(const Document& document, std::string_view text);

/// The documents in `file`, in order: one for a plain or gzipped file, one for each .gml, .xml or .citygml in
/// a zip archive. Throws Error when the file is missing, empty, unreadable or an archive without documents.
std::vector<Document> documents_in(const std::filesystem::path& file);

}  // namespace nightcity
