#include "tools/inventory/csv_encoding.h"

#include <iconv.h>

#include <array>
#include <cerrno>
#include <utility>

#include "formats/error.h"
#include "tools/city/text_encoding.h"
#include "tools/inventory/csv_head.h"
#include "tools/inventory/memory_folder.h"

namespace nightcity::inventory {
namespace {

constexpr std::array encodings{"CP932",  "EUC-JP", "GB18030",  "BIG5",   "CP949",
                               "CP1250", "CP1251", "CP1253",   "KOI8-R", "CP866",
                               "CP852",  "CP850",  "MACINTOSH"};

class Decoder {
 public:
  explicit Decoder(const char* encoding) : state_(::iconv_open("UTF-8", encoding)) {}
  ~Decoder() {
    if (is_known()) ::iconv_close(state_);
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  bool is_known() const { return state_ != reinterpret_cast<iconv_t>(-1); }

  std::string decode(std::string_view text) const {
    std::string out, bytes(text);
    std::array<char, 4096> block{};
    char* in = bytes.data();
    std::size_t left = bytes.size();
    while (left > 0) {
      char* end = block.data();
      std::size_t room = block.size();
      const std::size_t result = ::iconv(state_, &in, &left, &end, &room);
      out.append(block.data(), static_cast<std::size_t>(end - block.data()));
      if (result != static_cast<std::size_t>(-1) || errno == E2BIG) continue;
      out += "\xef\xbf\xbd";
      ++in, --left;
    }
    return out;
  }

 private:
  iconv_t state_;
};

}  // namespace

std::string find_csv_encoding(std::string_view start, const InventoryFile& inventory) {
  const std::string_view lines = start.substr(0, start.rfind('\n') + 1);  // whole characters
  const std::string text(lines.empty() ? start : lines);
  if (city::to_valid_utf8(text) == text || find_csv_head(text, inventory).is_found) return {};
  for (const char* encoding : encodings) {
    const Decoder decoder(encoding);
    if (decoder.is_known() && find_csv_head(decoder.decode(text), inventory).is_found)
      return encoding;
  }
  return {};
}

std::string decode_csv(std::string_view text, const std::string& encoding,
                       const std::string& file) {
  const Decoder decoder(encoding.c_str());
  std::string decoded = decoder.decode(text);
  if (decoded.size() > most_whole_bytes)
    throw Error(file, "is more than 1 GB in UTF-8: save its columns that are needed");
  return decoded;
}

}  // namespace nightcity::inventory
