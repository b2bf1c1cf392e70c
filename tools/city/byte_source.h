// The bytes of a document, whether it lies plain, in a stream (gzip, xz, ...) or in an archive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/error.h"

namespace nightcity::city {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Reads up to `size` bytes into `out` and returns how many; 0 at the end. Throws Error when the
  /// file cannot be read or decompressed.
  virtual std::size_t read(char* out, std::size_t size) = 0;
};

/// Returns the bytes of a file as it lies there. Throws Error where it cannot be read.
std::unique_ptr<ByteSource> open_file(const std::string& path);

/// Returns the next bytes of a source: `most`, or as many as there are.
std::string read_next(ByteSource& source, std::size_t most);

/// One document, to be read as often as needed. Text in UTF-16 is read as UTF-8.
struct Document {
  std::string name;     // the file's path, with the entry's name behind it in an archive
  bool packed = false;  // in a stream, or an archive's entry
  std::function<std::unique_ptr<ByteSource>()> open;
  /// Opens the same bytes as they are, whatever encoding they look like: those of a raster.
  std::function<std::unique_ptr<ByteSource>()> open_as_it_is{};
};

/// Returns the document's first bytes, unpacked: `most` of them, or all where there are fewer.
std::string read_start(const Document& document, std::size_t most);

/// Returns whether the document's bytes hold this text anywhere. One pass over all of it takes a
/// fiftieth of the time that a reader takes, over a compressed document a quarter.
bool mentions(const Document& document, std::string_view text);

/// The contents of a file.
struct FileContents {
  std::vector<Document> documents;  // in order
  // Names of an archive's entries that are packed themselves, by their endings, and so are no
  // documents.
  std::vector<std::string> packed_entries;
  /// An archive's entries that are no documents, counted by how their names end (".pdf"), or by what
  /// they are where they are no files ("link").
  std::map<std::string, std::size_t> others;
};

/// Thrown for an archive that is sound, but holds no entry of the endings that were asked for.
class NothingInside : public Error {
 public:
  NothingInside(std::string_view file, const std::string& what)
      : Error(file, "the archive " + what), what_(what) {}
  /// Returns what it holds instead: "holds no .gml, but a.tif: heights belong in [terrain] dem".
  const std::string& holds() const { return what_; }

 private:
  std::string what_;
};

/// Returns what `file` holds. Its documents are one for a plain file or one in a stream, and of an
/// archive one for each entry whose name ends with one of `endings` (in lower case: ".gml"), also
/// where the entry lies in an archive in the archive, or is a stream itself (".gml.gz"), which is
/// then read under its name without ".gz". Throws Error when the file is missing, empty, unreadable
/// or a folder, or a broken archive; NothingInside for an archive without such entries. The reader
/// of a document finds out whether it is of the kind that its name says.
FileContents list_contents(const std::filesystem::path& file,
                           std::span<const std::string_view> endings);

/// Returns the documents alone.
std::vector<Document> list_documents(const std::filesystem::path& file,
                                     std::span<const std::string_view> endings);

bool ends_with_any(std::string_view name, std::span<const std::string_view> endings);
/// Returns ".gml, .xml, .citygml": for messages.
std::string join_endings(std::span<const std::string_view> endings);

}  // namespace nightcity::city
