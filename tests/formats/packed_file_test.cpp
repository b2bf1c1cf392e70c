// Packed files are named with the remedy, and what readers unpack themselves is not among them.
#include "formats/packed_file.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace nightcity {
namespace {

using namespace std::string_literals;

TEST(PackedFile, IsNamedWithItsRemedy) {
  const std::pair<std::string, const char*> files[] = {
      {"\xFD"
       "7zXZ\0"s,
       "unxz"},
      {"\x28\xB5\x2F\xFD"s, "unzstd"},
      {"\x04\x22\x4D\x18"s, "unlz4"},
      {"7z\xBC\xAF\x27\x1C"s, "7z x"},
      {"Rar!\x1A\x07\x01"s, "RAR archive"},
      {std::string(257, 'a') + "ustar", "tar -xf"}};
  for (const auto& [start, remedy] : files)
    EXPECT_NE(describe_packed(start).find(remedy), std::string_view::npos) << remedy;
}

TEST(PackedFile, WhatReadersUnpackOrCannotKnowIsNotNamed) {
  for (const std::string& start : {"\x1F\x8B\x08"s, "BZh91AY"s, "PK\x03\x04"s, ""s, "ustar"s})
    EXPECT_TRUE(describe_packed(start).empty()) << start;
}

}  // namespace
}  // namespace nightcity
