// A reader of archives and streams by libarchive: bytes come from sources, faults are Errors.
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/packing.h"

struct archive;
struct archive_entry;

namespace nightcity::city {

/// Reads the entries of an archive, or the one of a stream, in their order and once.
class LibarchiveReader {
 public:
  /// `name`: for messages. Of a stream and of tar the bytes come from `source`.
  LibarchiveReader(Packing packing, std::unique_ptr<ByteSource> source, std::string name);
  /// Reads an archive that has to be searched, from a file on the disk.
  LibarchiveReader(Packing packing, const std::string& path, std::string name);
  ~LibarchiveReader();
  LibarchiveReader(const LibarchiveReader&) = delete;
  LibarchiveReader& operator=(const LibarchiveReader&) = delete;

  /// Goes on to the next entry, and returns it; null behind the last. Throws Error where the
  /// archive is broken, encrypted or packed in an unknown way.
  archive_entry* find_next();
  /// Returns the entry's path in UTF-8: what is not is taken as Windows-1252.
  std::string find_path(archive_entry* entry) const;
  /// Returns the path of the earlier entry that this one is a hard link to; "" where it is none.
  std::string find_link(archive_entry* entry) const;
  /// Reads the entry's next bytes, and zeros for its holes; 0 at its end. Throws as find_next().
  std::size_t read(char* out, std::size_t size);
  /// Throws Error where the source holds more that is broken, or a tar ends without its mark.
  void require_end();
  /// Throws Error: it is broken, for this reason.
  [[noreturn]] void fail(const std::string& why) const;

 private:
  struct Deleter {
    void operator()(archive* reader) const;
  };
  explicit LibarchiveReader(Packing packing, std::string name);
  static long pull(archive* reader, void* self, const void** bytes);
  [[noreturn]] void fail();
  /// Throws what `result` of libarchive says; for `is_data` a warning is damage too.
  void check(long result, bool is_data);

  Packing packing_;
  std::string name_;
  std::unique_ptr<ByteSource> source_;
  std::vector<char> block_;
  std::size_t pulled_ = 0;     // bytes of the source, all together
  std::string tail_;           // its last bytes so far
  std::exception_ptr thrown_;  // by the source, which libarchive must not see
  std::unique_ptr<archive, Deleter> reader_;
};

}  // namespace nightcity::city
