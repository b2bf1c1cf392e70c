#include "tools/city/libarchive_reader.h"

#include <archive.h>
#include <archive_entry.h>
#include <clocale>

#include <algorithm>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/text_encoding.h"

namespace nightcity::city {
namespace {

constexpr std::size_t pulled_block = std::size_t{1} << 16;
constexpr std::size_t tar_block = 512;

// libarchive translates names by the locale of the thread, which programs here leave at "C".
class Utf8Locale {
 public:
  Utf8Locale() : before_(uselocale(shared())) {}
  ~Utf8Locale() { uselocale(before_); }
  Utf8Locale(const Utf8Locale&) = delete;
  Utf8Locale& operator=(const Utf8Locale&) = delete;

 private:
  static locale_t shared() {
    static const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    return utf8;  // null, where there is none, changes nothing
  }
  locale_t before_;
};

int (*find_support(Packing packing))(archive*) {
  switch (packing) {
    case Packing::bzip2:
      return archive_read_support_filter_bzip2;
    case Packing::xz:
      return archive_read_support_filter_xz;
    case Packing::lzma:
      return archive_read_support_filter_lzma;
    case Packing::zstd:
      return archive_read_support_filter_zstd;
    case Packing::lz4:
      return archive_read_support_filter_lz4;
    case Packing::lzip:
      return archive_read_support_filter_lzip;
    case Packing::compress:
      return archive_read_support_filter_compress;
    case Packing::tar:
      return archive_read_support_format_tar;
    case Packing::seven_zip:
      return archive_read_support_format_7zip;
    case Packing::rar:
      return archive_read_support_format_rar;
    case Packing::none:  // these have readers of their own
    case Packing::gzip:
    case Packing::zip:
      break;
  }
  return nullptr;
}

}  // namespace

LibarchiveReader::LibarchiveReader(Packing packing, std::string name)
    : packing_(packing), name_(std::move(name)), reader_(archive_read_new()) {
  const auto support = find_support(packing);
  if (!reader_ || !support) throw Error(name_, "there is no memory for it");
  support(reader_.get());
  if (packing == Packing::rar) archive_read_support_format_rar5(reader_.get());
  if (!is_stream(packing)) return;
  archive_read_support_format_raw(reader_.get());
  archive_read_support_format_empty(reader_.get());
}

LibarchiveReader::LibarchiveReader(Packing packing, std::unique_ptr<ByteSource> source,
                                   std::string name)
    : LibarchiveReader(packing, std::move(name)) {
  source_ = std::move(source);
  block_.resize(pulled_block);
  check(archive_read_open(reader_.get(), this, nullptr, pull, nullptr), false);
  // Bytes that no filter takes would pass as they are.
  if (is_stream(packing_) && archive_filter_count(reader_.get()) < 2) fail("damaged");
}

LibarchiveReader::LibarchiveReader(Packing packing, const std::string& path, std::string name)
    : LibarchiveReader(packing, std::move(name)) {
  check(archive_read_open_filename(reader_.get(), path.c_str(), pulled_block), false);
}

LibarchiveReader::~LibarchiveReader() = default;

void LibarchiveReader::Deleter::operator()(archive* reader) const {
  archive_read_free(reader);
}

long LibarchiveReader::pull(archive*, void* self, const void** bytes) {
  auto& reader = *static_cast<LibarchiveReader*>(self);
  *bytes = reader.block_.data();
  try {
    const std::size_t got = reader.source_->read(reader.block_.data(), reader.block_.size());
    reader.pulled_ += got;
    const std::string_view seen(reader.block_.data(), got);
    reader.tail_.append(seen.substr(got - std::min(got, tar_block)));
    reader.tail_.erase(0, reader.tail_.size() - std::min(reader.tail_.size(), tar_block));
    return static_cast<long>(got);
  } catch (...) {
    reader.thrown_ = std::current_exception();
    return ARCHIVE_FATAL;
  }
}

void LibarchiveReader::fail() {
  if (thrown_) std::rethrow_exception(thrown_);
  const char* said = archive_error_string(reader_.get());
  const std::string why = said ? to_valid_utf8(said) : "damaged";
  fail(why);
}

void LibarchiveReader::fail(const std::string& why) const {
  const std::string lower = to_lower(why);
  if (is_named_as_volume(to_lower(name_))) throw Error(name_, volume_words);
  for (const char* word : {"encrypt", "crypto", "password"})
    if (lower.find(word) != lower.npos)
      throw Error(name_, "is encrypted with a password: unpack it first");
  if (is_stream(packing_))
    throw Error(name_, std::string("broken ") + name_of(packing_) + " stream: " + why);
  throw Error(name_, std::string("broken ") + name_of(packing_) +
                         " archive, or one of a kind that "
                         "is not read (" +
                         why + "): fetch it again, or unpack it yourself");
}

void LibarchiveReader::check(long result, bool is_data) {
  if (thrown_ || result < (is_data ? ARCHIVE_OK : ARCHIVE_WARN)) fail();
}

archive_entry* LibarchiveReader::find_next() {
  const Utf8Locale names;
  archive_entry* entry = nullptr;
  const int result = archive_read_next_header(reader_.get(), &entry);
  if (result == ARCHIVE_EOF && !thrown_) return nullptr;
  check(result, false);
  return entry;
}

std::string LibarchiveReader::find_path(archive_entry* entry) const {
  const Utf8Locale names;
  const char* path = archive_entry_pathname_utf8(entry);
  if (!path) path = archive_entry_pathname(entry);
  return decode_text(path ? path : "");
}

std::string LibarchiveReader::find_link(archive_entry* entry) const {
  const Utf8Locale names;
  const char* target = archive_entry_hardlink_utf8(entry);
  if (!target) target = archive_entry_hardlink(entry);
  return decode_text(target ? target : "");
}

std::size_t LibarchiveReader::read(char* out, std::size_t size) {
  const la_ssize_t got = archive_read_data(reader_.get(), out, size);
  check(got, true);
  return static_cast<std::size_t>(got);
}

void LibarchiveReader::require_end() {
  if (!source_) return;
  const bool ends_with_source =
      static_cast<std::size_t>(archive_filter_bytes(reader_.get(), 0)) == pulled_;
  // Behind the last entry stand the sums of the stream that the archive is packed in.
  const void* ignored = nullptr;
  while (pull(reader_.get(), this, &ignored) > 0) continue;
  if (thrown_) fail();
  const bool has_mark = std::all_of(tail_.begin(), tail_.end(), [](char c) { return c == '\0'; });
  if (packing_ == Packing::tar && ends_with_source && !has_mark)
    throw Error(name_,
                "broken tar archive: it has no end, as if cut off: fetch it again, or unpack it "
                "yourself");
}

}  // namespace nightcity::city
