// An archive whose list of entries says of one that it is packed into more bytes than there are.
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/city/byte_source.h"
#include "tools/city/unpacked_size.h"

namespace nightcity::city {
namespace {

std::string to_bytes(std::initializer_list<std::pair<std::uint32_t, int>> numbers) {
  std::string bytes;
  for (const auto& [number, size] : numbers)
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
  return bytes;
}

// Returns a megabyte of blanks as deflate packs it, behind which others of its kind may stand.
std::string pack_blanks() {
  std::string blanks(std::size_t{1} << 20, ' '), packed(8192, '\0');
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(blanks.data());
  stream.avail_in = static_cast<uInt>(blanks.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FULL_FLUSH), Z_OK);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

// Two hundred times the bytes that it claims would be hundreds of gigabytes.
TEST(LyingArchive, NoEntryIsPackedIntoMoreBytesThanTheArchiveHas) {
  constexpr std::uint32_t megabytes = 1100, claimed = 0xfffffff0, unpacked = megabytes << 20;
  const std::string name = "a.gml", blanks = pack_blanks();
  const std::string facts = to_bytes({{8, 2},
                                      {0, 4},
                                      {0, 4},
                                      {claimed, 4},
                                      {unpacked, 4},
                                      {static_cast<std::uint32_t>(name.size()), 2},
                                      {0, 2}});
  std::string bytes = "PK\x03\x04" + to_bytes({{20, 2}, {0, 2}}) + facts + name;
  for (std::uint32_t i = 0; i < megabytes; ++i) bytes += blanks;
  const auto begin = static_cast<std::uint32_t>(bytes.size());
  const std::string list = "PK\x01\x02" + to_bytes({{20, 2}, {20, 2}, {0, 2}}) + facts +
                           to_bytes({{0, 2}, {0, 2}, {0, 2}, {0, 4}, {0, 4}}) + name;
  bytes += list + "PK\x05\x06" +
           to_bytes({{0, 4},
                     {1, 2},
                     {1, 2},
                     {static_cast<std::uint32_t>(list.size()), 4},
                     {begin, 4},
                     {0, 2}});
  const test::TempFolder folder;
  test::write_text(folder / "a.zip", bytes);
  constexpr std::array<std::string_view, 1> endings{".gml"};
  const auto source = list_documents(folder / "a.zip", endings).front().open_as_it_is();
  std::vector<char> block(std::size_t{1} << 20);
  std::string why;
  try {
    while (source->read(block.data(), block.size()) > 0) continue;
  } catch (const Error& error) {
    why = error.what();
  }
  EXPECT_NE(why.find("200 times"), std::string::npos) << why;
}

TEST(LyingArchive, TheLimitOfALargeFileHasRoom) {
  UnpackedSize size("a", ~std::uint64_t{0} / 200 + 2);
  EXPECT_NO_THROW(size.add(std::size_t{1} << 40));
}

}  // namespace
}  // namespace nightcity::city
