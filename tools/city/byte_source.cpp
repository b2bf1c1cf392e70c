#include "tools/city/byte_source.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

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
#include "tools/city/foreign_format.h"
#include "tools/city/inflate_source.h"
#include "tools/city/text_encoding.h"
#include "tools/city/unpacked_size.h"
#include "tools/city/zip_archive.h"

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

class GzipSource : public ByteSource {
 public:
  explicit GzipSource(const std::string& name)
      : file_(gzopen(name.c_str(), "rb")), name_(name), unpacked_(name, find_packed_size(name)) {
    if (!file_) throw Error(name_, "cannot open the gzip stream");
    gzbuffer(file_, 1u << 18);
  }
  ~GzipSource() override { gzclose(file_); }
  GzipSource(const GzipSource&) = delete;
  GzipSource& operator=(const GzipSource&) = delete;

  std::size_t read(char* out, std::size_t size) override {
    const int got =
        gzread(file_, out, static_cast<unsigned>(std::min<std::size_t>(size, 1u << 30)));
    int status = Z_OK;
    const char* message = gzerror(file_, &status);
    // A stream cut short gives its last bytes first and the error with them.
    if (got < 0 || (status != Z_OK && status != Z_STREAM_END))
      throw Error(name_, std::string("broken gzip stream: ") +
                             (message && *message ? message : "truncated"));
    unpacked_.add(static_cast<std::size_t>(got));
    return static_cast<std::size_t>(got);
  }

 private:
  gzFile file_;
  std::string name_;
  UnpackedSize unpacked_;
};

constexpr std::array<std::string_view, 8> packed_endings = {".zip", ".gz",  ".tgz", ".tar",
                                                            ".7z",  ".bz2", ".xz",  ".rar"};

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
std::string explain_entry(const ZipEntry& entry, const std::string& path) {
  constexpr std::size_t start_bytes = 4096;
  try {
    return explain_foreign(read_next(*entry.open(path + "/" + entry.inside), start_bytes),
                           to_lower(entry.inside));
  } catch (const Error&) {
    return {};
  }
}

FileContents list_archive(const std::string& path, std::span<const std::string_view> endings) {
  FileContents contents;
  std::string first_entry, first_raster;
  const std::vector<ZipEntry> entries = list_zip_entries(path);
  for (const ZipEntry& entry : entries) {
    const std::string& inside = entry.inside;
    const std::string lower = to_lower(inside);
    if (first_entry.empty()) first_entry = inside;
    if (first_raster.empty() && ends_with_any(lower, raster_endings)) first_raster = inside;
    // A stream is read under the name of what is in it.
    const std::size_t gzip = lower.ends_with(".gz") ? std::string_view(".gz").size() : 0;
    const bool is_wanted = ends_with_any(lower.substr(0, lower.size() - gzip), endings);
    if (!is_wanted && ends_with_any(lower, packed_endings))
      contents.packed_entries.push_back(inside);
    if (!is_wanted) {
      ++contents.others[ending_of(lower)];
      continue;
    }
    const std::string name = path + "/" + inside.substr(0, inside.size() - gzip);
    contents.documents.push_back(make_document(name, true, [=]() -> std::unique_ptr<ByteSource> {
      auto source = entry.open(name);
      if (gzip == 0) return source;
      return inflate_stream(std::move(source), name, entry.packed_size());
    }));
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
  if (first_entry.empty()) throw NothingInside(path, none);
  const std::string words = explain_entry(entries.front(), path);
  throw NothingInside(
      path, none + ", but " + first_entry + (words.empty() ? remedy : ", which " + words));
}

std::string read_mark(const std::string& path) {
  std::string mark(zip_mark.size(), '\0');
  mark.resize(PlainSource(path).read(mark.data(), mark.size()));
  return mark;
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
  const std::string mark = read_mark(path);
  if (mark.empty()) throw Error(path, "is empty");
  if (mark == zip_mark) return list_archive(path, endings);
  if (mark.starts_with("\x1f\x8b"))
    return {
        {make_document(path, true, [=] { return std::make_unique<GzipSource>(path); })}, {}, {}};
  return {
      {make_document(path, false, [=] { return std::make_unique<PlainSource>(path); })}, {}, {}};
}

std::vector<Document> list_documents(const std::filesystem::path& file,
                                     std::span<const std::string_view> endings) {
  return list_contents(file, endings).documents;
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
