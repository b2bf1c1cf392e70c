#include "tools/city/stream_source.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "tools/city/libarchive_reader.h"
#include "tools/city/unpacked_size.h"

namespace nightcity::city {
namespace {

constexpr std::size_t packed_block = std::size_t{1} << 16;
constexpr Bytef first_gzip_byte = 0x1F;  // of a gzip stream

class InflateSource : public ByteSource {
 public:
  InflateSource(std::unique_ptr<ByteSource> source, std::string name, std::uint64_t packed)
      : source_(std::move(source)),
        name_(std::move(name)),
        unpacked_(name_, packed),
        block_(packed_block) {
    constexpr int gzip_alone = 16 + MAX_WBITS;
    if (inflateInit2(&state_, gzip_alone) != Z_OK) throw Error(name_, "there is no memory for it");
  }
  ~InflateSource() override { inflateEnd(&state_); }
  InflateSource(const InflateSource&) = delete;
  InflateSource& operator=(const InflateSource&) = delete;

  std::size_t read(char* out, std::size_t size) override {
    size = std::min<std::size_t>(size, std::numeric_limits<uInt>::max());
    state_.next_out = reinterpret_cast<Bytef*>(out);
    state_.avail_out = static_cast<uInt>(size);
    while (state_.avail_out == size && !is_at_end_ && size > 0) inflate_some();
    const std::size_t got = size - state_.avail_out;
    unpacked_.add(got);
    return got;
  }

 private:
  void inflate_some() {
    if (state_.avail_in == 0) {
      state_.next_in = reinterpret_cast<Bytef*>(block_.data());
      state_.avail_in = static_cast<uInt>(source_->read(block_.data(), block_.size()));
    }
    // Streams may follow each other. What else follows is none of them, as gunzip has it.
    const bool is_over = state_.avail_in == 0;
    if (is_between_ && (is_over || *state_.next_in != first_gzip_byte)) {
      is_at_end_ = true;
      return;
    }
    if (is_between_) inflateReset(&state_);
    is_between_ = false;
    const int result = is_over ? Z_DATA_ERROR : inflate(&state_, Z_NO_FLUSH);
    if (result != Z_OK && result != Z_STREAM_END)
      throw Error(name_, std::string("broken gzip stream: ") + (is_over      ? "truncated"
                                                                : state_.msg ? state_.msg
                                                                             : "damaged"));
    is_between_ = result == Z_STREAM_END;
  }

  std::unique_ptr<ByteSource> source_;
  std::string name_;
  UnpackedSize unpacked_;
  std::vector<char> block_;
  z_stream state_{};
  bool is_between_ = false, is_at_end_ = false;
};

// The other kinds, whose sums their libraries compare.
class FilteredSource : public ByteSource {
 public:
  FilteredSource(Packing packing, std::unique_ptr<ByteSource> source, const std::string& name,
                 std::uint64_t packed)
      : reader_(packing, std::move(source), name),
        unpacked_(name, packed),
        holds_bytes_(reader_.find_next() != nullptr) {}

  std::size_t read(char* out, std::size_t size) override {
    const std::size_t got = holds_bytes_ ? reader_.read(out, size) : 0;
    unpacked_.add(got);
    return got;
  }

 private:
  LibarchiveReader reader_;
  UnpackedSize unpacked_;
  bool holds_bytes_;
};

}  // namespace

std::unique_ptr<ByteSource> unpack_stream(Packing packing, std::unique_ptr<ByteSource> source,
                                          const std::string& name, std::uint64_t packed) {
  if (packing == Packing::gzip)
    return std::make_unique<InflateSource>(std::move(source), name, packed);
  return std::make_unique<FilteredSource>(packing, std::move(source), name, packed);
}

}  // namespace nightcity::city
