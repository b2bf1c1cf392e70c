#include "tools/citygml/byte_source.h"

#include <fcntl.h>
#include <unistd.h>
#include <zip.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "formats/error.h"

namespace nightcity {
namespace {

class PlainSource : public ByteSource {
 public:
  PlainSource(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
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
  explicit GzipSource(std::string name) : file_(gzopen(name.c_str(), "rb")), name_(std::move(name)) {
    if (!file_) throw Error(name_, "cannot open the gzip stream");
    gzbuffer(file_, 1u << 18);
  }
  ~GzipSource() override { gzclose(file_); }
  GzipSource(const GzipSource&) = delete;
  GzipSource& operator=(const GzipSource&) = delete;

  std::size_t read(char* out, std::size_t size) override {
    const int got = gzread(file_, out, static_cast<unsigned>(std::min<std::size_t>(size, 1u << 30)));
    int status = Z_OK;
    const char* message = gzerror(file_, &status);
    // A stream cut short gives its last bytes first and the error with them.
    if (got < 0 || (status != Z_OK && status != Z_STREAM_END))
      throw Error(name_, std::string("broken gzip stream: ") + (message && *message ? message : "truncated"));
    return static_cast<std::size_t>(got);
  }

 private:
  gzFile file_;
  std::string name_;
};

struct ZipDeleter {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

class ZipSource : public ByteSource {
 public:
  ZipSource(zip_t* archive, zip_uint64_t index, std::string name)
      : entry_(zip_fopen_index(archive, index, 0)), name_(std::move(name)) {
    if (!entry_) throw Error(name_, std::string("cannot open the archive's entry: ") + zip_strerror(archive));
  }
  std::size_t read(char* out, std::size_t size) override {
    const zip_int64_t got = zip_fread(entry_.get(), out, size);
    if (got < 0) throw Error(name_, "broken archive entry");
    return static_cast<std::size_t>(got);
  }

 private:
  std::unique_ptr<zip_file_t, ZipDeleter> entry_;
  std::string name_;
};

bool is_document(std::string_view entry) {
  std::string lower(entry);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower.ends_with(".gml") || lower.ends_with(".xml") || lower.ends_with(".citygml");
}

void for_each_entry(const std::string& path,
                    const std::function<void(ByteSource& source, const std::string& name)>& use) {
  int code = 0;
  const std::unique_ptr<zip_t, ZipDeleter> archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive) throw Error(path, "broken zip archive");
  std::vector<std::pair<std::string, zip_uint64_t>> entries;
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* name = zip_get_name(archive.get(), static_cast<zip_uint64_t>(i), ZIP_FL_ENC_GUESS);
    if (name && is_document(name)) entries.emplace_back(name, static_cast<zip_uint64_t>(i));
  }
  if (entries.empty()) throw Error(path, "the archive holds no .gml, .xml or .citygml");
  for (const auto& [name, index] : entries) {
    const std::string full = path + "/" + name;
    ZipSource source(archive.get(), index, full);
    use(source, full);
  }
}

}  // namespace

void for_each_document(const std::filesystem::path& file,
                       const std::function<void(ByteSource& source, const std::string& name)>& use) {
  const std::string path = file.string();
  if (std::filesystem::is_directory(file)) throw Error(path, "is a folder, not a CityGML file");
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error(path, std::string("cannot open: ") + std::strerror(errno));
  auto plain = std::make_unique<PlainSource>(descriptor, path);
  unsigned char magic[4] = {};
  const ssize_t got = ::pread(descriptor, magic, sizeof magic, 0);
  if (got == 0) throw Error(path, "is empty");
  if (got >= 2 && magic[0] == 0x1f && magic[1] == 0x8b) {
    GzipSource source(path);
    use(source, path);
  } else if (got == 4 && std::memcmp(magic, "PK\x03\x04", 4) == 0) {
    for_each_entry(path, use);
  } else {
    use(*plain, path);
  }
}

}  // namespace nightcity
