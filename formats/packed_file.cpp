#include "formats/packed_file.h"

#include <cstddef>

namespace nightcity {
namespace {

using namespace std::string_view_literals;

struct Mark {
  std::size_t at;  // offset of the mark
  std::string_view bytes;
  std::string_view description;
};

constexpr Mark marks[] = {
    {257, "ustar"sv, "is a tar archive: unpack it first (tar -xf) and name the files in it"sv},
    {0,
     "\xFD"
     "7zXZ\0"sv,
     "is packed by xz: unpack it first (unxz)"sv},
    {0, "\x28\xB5\x2F\xFD"sv, "is packed by zstd: unpack it first (unzstd)"sv},
    {0, "\x04\x22\x4D\x18"sv, "is packed by lz4: unpack it first (unlz4)"sv},
    {0, "7z\xBC\xAF\x27\x1C"sv, "is a 7z archive: unpack it first (7z x)"sv},
    {0, "Rar!\x1A\x07"sv, "is a RAR archive: unpack it first"sv},
};

}  // namespace

std::string_view describe_packed(std::string_view start) {
  for (const Mark& mark : marks)
    if (start.size() >= mark.at && start.substr(mark.at).starts_with(mark.bytes))
      return mark.description;
  return {};
}

}  // namespace nightcity
