#include "tools/city/zip_archive.h"

#include <zip.h>

#include <algorithm>
#include <mutex>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/hidden_entry.h"
#include "tools/city/packing.h"
#include "tools/city/unpacked_size.h"

namespace nightcity::city {
namespace {

struct ZipDeleter {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

// An archive, opened once for all of its entries: opening reads the list of them, so that opening
// for each entry anew would take time quadratic in their number. libzip's handles are for one
// thread at a time.
class ZipArchive : public OpenArchive, public std::enable_shared_from_this<ZipArchive> {
 public:
  ZipArchive(const std::string& path, const std::string& name,
             std::shared_ptr<ScratchFile> unpacked)
      : unpacked_(std::move(unpacked)),
        size_(unpacked_ ? unpacked_->size() : find_packed_size(path)),
        archive_(zip_open(path.c_str(), ZIP_RDONLY, nullptr)) {
    if (archive_) return;
    if (is_named_as_volume(to_lower(name))) throw Error(name, volume_words);
    throw Error(name, "broken zip archive: damaged or cut off; fetch it again");
  }

  zip_t* get() const { return archive_.get(); }
  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }
  std::uint64_t kept_bytes() const override { return unpacked_ ? unpacked_->size() : 0; }
  std::uint64_t packed_size(std::uint64_t index) override {
    const auto held = lock();
    zip_stat_t status;
    zip_stat_init(&status);
    const bool known = zip_stat_index(get(), index, 0, &status) == 0;
    // No entry is larger than the archive, whatever it says.
    return known && (status.valid & ZIP_STAT_COMP_SIZE) ? std::min(status.comp_size, size_) : 0;
  }
  std::unique_ptr<ByteSource> open(std::uint64_t index, const std::string& name) override;

 private:
  std::mutex mutex_;
  std::shared_ptr<ScratchFile> unpacked_;
  std::uint64_t size_;
  std::unique_ptr<zip_t, ZipDeleter> archive_;
};

class ZipSource : public ByteSource {
 public:
  ZipSource(std::shared_ptr<ZipArchive> archive, zip_uint64_t index, std::string name)
      : archive_(std::move(archive)),
        name_(std::move(name)),
        unpacked_(name_, archive_->packed_size(index)) {
    const auto lock = archive_->lock();
    entry_.reset(zip_fopen_index(archive_->get(), index, 0));
    if (entry_) return;
    const int why = zip_error_code_zip(zip_get_error(archive_->get()));
    if (why == ZIP_ER_NOPASSWD) throw Error(name_, "is encrypted with a password: unpack it first");
    throw Error(name_, std::string("cannot open the archive's entry: ") +
                           zip_strerror(archive_->get()) +
                           (why == ZIP_ER_COMPNOTSUPP ? ": unpack it first" : ""));
  }
  ~ZipSource() override {
    const auto lock = archive_->lock();
    entry_.reset();
  }
  ZipSource(const ZipSource&) = delete;
  ZipSource& operator=(const ZipSource&) = delete;

  std::size_t read(char* out, std::size_t size) override {
    const auto lock = archive_->lock();
    const zip_int64_t got = zip_fread(entry_.get(), out, size);
    if (got < 0) throw Error(name_, "broken archive entry");
    unpacked_.add(static_cast<std::size_t>(got));
    return static_cast<std::size_t>(got);
  }

 private:
  std::shared_ptr<ZipArchive> archive_;
  std::unique_ptr<zip_file_t, ZipDeleter> entry_;
  std::string name_;
  UnpackedSize unpacked_;
};

std::unique_ptr<ByteSource> ZipArchive::open(std::uint64_t index, const std::string& name) {
  return std::make_unique<ZipSource>(shared_from_this(), index, name);
}

// Programs of Unix store a link as a file that holds the path it leads to.
bool is_link(zip_t* archive, zip_uint64_t index) {
  constexpr zip_uint32_t kind = 0170000, link = 0120000;
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  return zip_file_get_external_attributes(archive, index, 0, &system, &attributes) == 0 &&
         system == ZIP_OPSYS_UNIX && (attributes >> 16 & kind) == link;
}

}  // namespace

ArchiveListing list_zip(const std::string& path, const std::string& name,
                        std::shared_ptr<ScratchFile> unpacked) {
  const auto archive = std::make_shared<ZipArchive>(path, name, std::move(unpacked));
  ArchiveListing listing;
  const zip_int64_t count = zip_get_num_entries(archive->get(), 0);
  listing.entries.reserve(static_cast<std::size_t>(std::max<zip_int64_t>(count, 0)));
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* inside = zip_get_name(archive->get(), index, ZIP_FL_ENC_GUESS);
    if (!inside || is_hidden_entry(inside) || std::string_view(inside).ends_with('/')) continue;
    if (is_link(archive->get(), index))
      ++listing.left_out["link"];
    else
      listing.entries.push_back({inside, archive, index});
  }
  return listing;
}

}  // namespace nightcity::city
