#include "tools/city/text_pieces.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/input_file.h"
#include "tools/city/line_ends.h"

namespace nightcity::city {
namespace {

// A file read at any place.
class PlacedFile {
 public:
  explicit PlacedFile(const std::filesystem::path& path) : name_(path.string()) {
    refuse_special_file(path);
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw Error(name_, std::string("cannot open: ") + std::strerror(errno));
  }
  ~PlacedFile() { ::close(descriptor_); }
  PlacedFile(const PlacedFile&) = delete;
  PlacedFile& operator=(const PlacedFile&) = delete;

  std::size_t read(std::uint64_t at, char* out, std::size_t size) const {
    for (;;) {
      const ssize_t got = ::pread(descriptor_, out, size, static_cast<off_t>(at));
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) throw Error(name_, std::string("cannot read: ") + std::strerror(errno));
    }
  }

 private:
  std::string name_;
  int descriptor_ = -1;
};

bool ends_mark(char c) {
  return c == '>' || c == '/' || c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

// Returns the first place at or behind `from` where a member begins, else the file's end.
std::uint64_t find_mark(const PlacedFile& file, const FileCuts& cuts, std::uint64_t from) {
  if (from <= cuts.head_end) return cuts.head_end;  // the first piece has all that follows the head
  constexpr std::size_t step = std::size_t{1} << 16;
  std::string window;
  for (std::uint64_t at = from; at < cuts.size;) {
    window.resize(step + cuts.mark.size());
    window.resize(file.read(at, window.data(), window.size()));
    for (std::size_t found = window.find(cuts.mark); found != std::string::npos;
         found = window.find(cuts.mark, found + 1)) {
      const std::size_t behind = found + cuts.mark.size();
      if (behind < window.size() && ends_mark(window[behind])) return at + found;
    }
    if (window.size() <= cuts.mark.size()) break;
    at += window.size() - cuts.mark.size();  // a mark may lie across the border
  }
  return cuts.size;
}

std::size_t count_lines_before(const PlacedFile& file, const FileCuts& cuts, std::uint64_t before) {
  const auto block = static_cast<std::size_t>(before / FileCuts::block);
  const std::uint64_t begin = block * FileCuts::block;
  std::string text(static_cast<std::size_t>(before - begin), '\0');
  text.resize(file.read(begin, text.data(), text.size()));
  return static_cast<std::size_t>(cuts.line_ends.at(block)) + count_line_ends(text);
}

class PieceSource : public ByteSource {
 public:
  PieceSource(const std::filesystem::path& path, TextPiece piece)
      : file_(path), piece_(std::move(piece)) {}

  std::size_t read(char* out, std::size_t size) override {
    if (at_ == piece_.head_end && !in_body_) {
      at_ = piece_.begin;
      in_body_ = true;
    }
    const std::uint64_t end = in_body_ ? piece_.end : piece_.head_end;
    if (at_ < end) {
      const std::size_t got =
          file_.read(at_, out, static_cast<std::size_t>(std::min<std::uint64_t>(size, end - at_)));
      at_ += got;
      if (got > 0) return got;
    }
    const std::size_t got = std::min(size, piece_.tail.size() - tail_read_);
    std::memcpy(out, piece_.tail.data() + tail_read_, got);
    tail_read_ += got;
    return got;
  }

 private:
  PlacedFile file_;
  TextPiece piece_;
  std::uint64_t at_ = 0;
  bool in_body_ = false;
  std::size_t tail_read_ = 0;
};

}  // namespace

std::optional<FileCuts> scan_cuts(const std::filesystem::path& path, FileCuts cuts,
                                  const std::string& forbidden) {
  const PlacedFile file(path);
  constexpr std::size_t step = std::size_t{1} << 18;  // stays in the second cache
  static_assert(FileCuts::block % step == 0);
  std::string window;
  std::size_t kept = 0;
  for (std::uint64_t ends = 0;;) {
    if (cuts.size % FileCuts::block == 0) cuts.line_ends.push_back(ends);
    window.resize(kept + step);
    std::size_t got = 0;
    while (got < step) {
      const std::size_t more = file.read(cuts.size + got, window.data() + kept + got, step - got);
      if (more == 0) break;
      got += more;
    }
    window.resize(kept + got);
    if (::memmem(window.data(), window.size(), forbidden.data(), forbidden.size())) return {};
    ends += count_line_ends(std::string_view(window).substr(kept));
    cuts.size += got;
    if (got < step) return cuts;
    kept = forbidden.size() - 1;  // the word may lie across the border
    window.erase(0, window.size() - kept);
  }
}

std::optional<TextPiece> find_piece(const std::filesystem::path& path, const FileCuts& cuts,
                                    std::uint64_t begin, std::uint64_t end) {
  const PlacedFile file(path);
  TextPiece piece;
  piece.head_end = cuts.head_end;
  piece.head_members = static_cast<std::size_t>(cuts.head_members);
  piece.begin = begin == 0 ? cuts.head_end : find_mark(file, cuts, begin);
  piece.end = end >= cuts.size ? cuts.size : find_mark(file, cuts, end);
  if (piece.begin >= piece.end) return {};
  if (piece.end < cuts.size) piece.tail = cuts.tail;
  if (!piece.is_first())
    piece.lines_left_out = count_lines_before(file, cuts, piece.begin) -
                           count_lines_before(file, cuts, piece.head_end);
  return piece;
}

std::unique_ptr<ByteSource> open_piece(const std::filesystem::path& file, const TextPiece& piece) {
  return std::make_unique<PieceSource>(file, piece);
}

}  // namespace nightcity::city
