#include "tools/city/byte_source.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/error.h"
#include "formats/input_file.h"
#include "formats/to_lower.h"
#include "tools/city/archive_entries.h"
#include "tools/city/foreign_format.h"
#include "tools/city/packing.h"
#include "tools/city/stream_source.h"
#include "tools/city/text_encoding.h"
#include "tools/city/unpacked_size.h"

namespace nightcity::city {
namespace {

class PlainSource : public ByteSource {
 public:
  explicit PlainSource(std::string name)
      : descriptor_(::open(name.c_str(), O_RDONLY | O_CLOEXEC)), name_(std::move(name)) {
    if (descriptor_ < 0) throw Error(name_, std::string("cannot open: ") + std::strerror(errno));
  }
  ~PlainSource() override { ::close(descriptor_); }
  PlainSource(const PlainSource&) = delete;
  PlainSource& operator=(const PlainSource&) = delete;

  std::size_t read(char* out, std::size_t size) override {
    for (;;) {
      const ssize_t got = ::read(descriptor_, out, size);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) throw Error(name_, std::string("cannot read: ") + std::strerror(errno));
    }
  }

 private:
  int descriptor_;
  std::string name_;
};

// Rasters of heights, which are told apart for what helps.
constexpr std::array<std::string_view, 6> raster_endings = {".tif", ".tiff", ".asc",
                                                            ".xyz", ".hgt",  ".flt"};

Document make_document(const std::string& name, bool packed,
                       const std::function<std::unique_ptr<ByteSource>()>& open) {
  return {name, packed, [open] { return to_utf8(open()); }, open};
}

// Returns ".pdf" of "docs/a.pdf"; the name of a file without an ending.
std::string ending_of(const std::string& name) {
  const std::filesystem::path path(name);
  return path.has_extension() ? path.extension().string() : path.filename().string();
}

// Returns what an entry that is of no use is instead, with the remedy; "" where it is not known.
std::string explain_entry(const ArchiveEntry& entry, const std::string& path) {
  constexpr std::size_t start_bytes = 4096;
  try {
    return explain_foreign(read_next(*entry.open(path + "/" + entry.inside), start_bytes),
                           to_lower(entry.inside));
  } catch (const Error&) {
    return {};
  }
}

// Opens an entry, and unpacks it where it is a stream, whatever its name says.
std::unique_ptr<ByteSource> open_unpacked(const ArchiveEntry& entry, const std::string& name) {
  auto source = entry.open(name);
  std::string start = read_next(*source, packing_bytes);
  const Packing packing = find_packing(start);
  source = resume(std::move(start), std::move(source));
  if (!is_checked_stream(packing)) return source;
  return unpack_stream(packing, std::move(source), name, entry.packed_size());
}

FileContents list_entries(const std::string& path, std::span<const std::string_view> endings) {
  FileContents contents;
  std::string first_entry, first_raster;
  const auto listing = list_archive(path);
  contents.others = listing->left_out;
  for (const ArchiveEntry& entry : listing->entries) {
    const std::string& inside = entry.inside;
    const std::string lower = to_lower(inside);
    if (first_entry.empty()) first_entry = inside;
    if (first_raster.empty() && ends_with_any(lower, raster_endings)) first_raster = inside;
    // A stream is read under the name of what is in it.
    const bool is_wanted = ends_with_any(without_stream_ending(lower), endings);
    if (!is_wanted && is_named_as_packed(lower)) contents.packed_entries.push_back(inside);
    if (!is_wanted) {
      ++contents.others[ending_of(lower)];
      continue;
    }
    const std::string name = path + "/" + std::string(without_stream_ending(inside));
    contents.documents.push_back(
        make_document(name, true, [=] { return open_unpacked(entry, name); }));
  }
  if (!contents.documents.empty()) return contents;
  const std::string none = "holds no " + join_endings(endings),
                    remedy = ": unpack it and name what is inside";
  if (!first_raster.empty())
    throw NothingInside(path, none + ", but " + first_raster + ": heights belong in [terrain] dem");
  if (!contents.packed_entries.empty())
    throw NothingInside(
        path, "holds another packed file (" + contents.packed_entries.front() + ")" + remedy);
  if (to_lower(first_entry).ends_with(".kml"))
    throw NothingInside(path, "holds KML (" + first_entry + "): export the model as CityGML first");
  if (first_entry.empty())
    throw NothingInside(path, none + (contents.others.empty() ? "" : ", but links alone"));
  const std::string words = explain_entry(listing->entries.front(), path);
  throw NothingInside(
      path, none + ", but " + first_entry + (words.empty() ? remedy : ", which " + words));
}

}  // namespace

bool ends_with_any(std::string_view name, std::span<const std::string_view> endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [name](std::string_view ending) { return name.ends_with(ending); });
}

std::string join_endings(std::span<const std::string_view> endings) {
  std::string all;
  for (const std::string_view ending : endings)
    all += std::string(all.empty() ? "" : ", ").append(ending);
  return all;
}

FileContents list_contents(const std::filesystem::path& file,
                           std::span<const std::string_view> endings) {
  const std::string path = file.string();
  std::error_code ignored;  // the opening says what is wrong
  if (std::filesystem::is_directory(file, ignored)) throw Error(path, "is a folder, not a file");
  refuse_special_file(file);
  const std::string start = read_next(*open_file(path), packing_bytes);
  if (start.empty()) throw Error(path, "is empty");
  if (holds_archive(path, start)) return list_entries(path, endings);
  const Packing packing = find_packing(start);
  if (!is_checked_stream(packing))
    return {{make_document(path, false, [=] { return open_file(path); })}, {}, {}};
  const auto open = [=] {
    return unpack_stream(packing, open_file(path), path, find_packed_size(path));
  };
  return {{make_document(path, true, open)}, {}, {}};
}

std::vector<Document> list_documents(const std::filesystem::path& file,
                                     std::span<const std::string_view> endings) {
  return list_contents(file, endings).documents;
}

std::unique_ptr<ByteSource> open_file(const std::string& path) {
  return std::make_unique<PlainSource>(path);
}

std::string read_next(ByteSource& source, std::size_t most) {
  constexpr std::size_t block = std::size_t{1} << 16;
  std::string bytes;
  for (std::size_t size = 0;;) {
    bytes.resize(size + std::min(block, most - size));
    const std::size_t got =
        bytes.size() > size ? source.read(bytes.data() + size, bytes.size() - size) : 0;
    size += got;
    if (got > 0) continue;
    bytes.resize(size);
    return bytes;
  }
}

std::string read_start(const Document& document, std::size_t most) {
  return read_next(*document.open(), most);
}

}  // namespace nightcity::city
