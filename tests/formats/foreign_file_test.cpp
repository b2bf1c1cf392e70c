// Files that are no glTF, and containers of glTF that are rare or damaged.
#include "formats/foreign_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "formats/gltf_samples.h"

namespace nightcity {
namespace {

using nlohmann::json;
using test::bytes_of;
using test::foreign;
using test::refusal;
using test::TempFolder;

// Returns the message for a file of these bytes; empty if it is read.
std::string refusal_of_bytes(std::string_view bytes) {
  const TempFolder folder;
  test::write_text(folder / "file.glb", bytes);
  try {
    read_scene(folder / "file.glb");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(ForeignFile, IsNamedWithTheRemedy) {
  const std::pair<std::string, const char*> cases[] = {
      {"\x1f\x8b\x08", "gunzip"},
      {"b3dm" + std::string(24, '\0'), "3D tile"},
      {"PK\x03\x04...", "zip archive"},
      {"NCLIGHTS", "give the .glb"},
      {"Kaydara FBX Binary  ", "FBX"},
      {"<?xml version=\"1.0\"?><core:CityModel xmlns:core=\"a\">", "nightbake run"},
      {"<!DOCTYPE html><html>", "web page"},
      {"\xef\xbb\xbf<!doctype HTML>", "web page"},
      {"{\"type\":\"CityJSON\",\"version\":\"1.1\"}", "CityJSON"},
      {"{\"asset\":{\"version\":\"1.0\"},\"geometricError\":1}", "tileset"},
      {"mtllib a.mtl\nv 0 0 0\n", "OBJ"},
      {std::string("\xff\xfe{\0", 4), "UTF-16"},
      {"version https://git-lfs.github.com/spec/v1\n", "git lfs pull"},
      {"{\"asset\":{\"version\":\"1.0\"}}", "convert it"},
      {"{\"asset\":{\"version\":\"2.1\",\"minVersion\":\"2.1\"}}", "minVersion"}};
  for (const auto& [bytes, words] : cases)
    EXPECT_NE(refusal_of_bytes(bytes).find(words), std::string::npos)
        << words << ": " << refusal_of_bytes(bytes);
}

std::string to_container(const json& document, const std::string& extra_chunk = "") {
  std::string text = document.dump();
  text.append(3 - (text.size() + 3) % 4, ' ');
  const auto word = [](std::size_t value) {
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)});
  };
  const std::string chunks = word(text.size()) + "JSON" + text + extra_chunk;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

TEST(Container, MayHoldOtherChunksAndBytesBehindIt) {
  const std::string odd = bytes_of<std::uint32_t>({4}) + "ODD!" + "1234";
  EXPECT_EQ(refusal_of_bytes(to_container(foreign(), odd)), "");
  EXPECT_EQ(refusal_of_bytes(to_container(foreign()) + "behind"), "");
  const std::string whole = to_container(foreign());
  EXPECT_NE(refusal_of_bytes(whole.substr(0, whole.size() - 1)).find("cut off"), std::string::npos);
}

TEST(Container, AByteOrderMarkMayStandBeforeTheJson) {
  EXPECT_EQ(refusal_of_bytes("\xef\xbb\xbf \r\n" + foreign().dump()), "");
}

TEST(Container, BuffersAreFoundAsExportersSpellThem) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "a b");
  json document = foreign();
  const std::string data =
      bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) + bytes_of<std::uint8_t>({0, 1, 2, 3});
  test::write_text(folder / "a b/50% c.bin", data);
  for (const char* uri : {"a%20b/50%25%20c.bin", "a b/50% c.bin", "a b\\50% c.bin",
                          "a%20b\\50%25%20c.bin", "./a b/50%25 c.bin"}) {
    document["buffers"][0]["uri"] = uri;
    test::write_text(folder / "file.gltf", document.dump());
    EXPECT_NO_THROW(read_scene(folder / "file.gltf")) << uri;
  }
  for (const char* uri : {"..\\a.bin", "a\\..\\..\\b.bin", "%2e%2e%5cb.bin"}) {
    document["buffers"][0]["uri"] = uri;
    EXPECT_NE(refusal(document).find("leaves the scene's folder"), std::string::npos) << uri;
  }
}

TEST(Container, SaysWhichBufferIsMissingAndWhy) {
  json document = foreign();
  const auto message = [&](const char* uri) {
    document["buffers"][0]["uri"] = uri;
    return refusal(document);
  };
  EXPECT_NE(message("https://example.org/m.bin").find("download it"), std::string::npos);
  EXPECT_NE(message("not there.bin").find("not there.bin is not there"), std::string::npos);
  EXPECT_NE(message("").find("names no file"), std::string::npos);
}

TEST(RequiredExtensions, AreNamedWithTheRemedyUnlessTheyChangeLooksOnly) {
  json document = foreign();
  document["extensionsRequired"] = {"EXT_meshopt_compression"};
  EXPECT_NE(refusal(document).find("gltf-transform copy"), std::string::npos) << refusal(document);
  document["extensionsRequired"] = {"KHR_from_the_future"};
  EXPECT_NE(refusal(document).find("KHR_from_the_future"), std::string::npos);
  document["extensionsRequired"] = {"KHR_texture_basisu", "KHR_materials_clearcoat"};
  document["extensionsUsed"] = document["extensionsRequired"];
  EXPECT_EQ(refusal(document), "");
  ASSERT_EQ(test::read(document).skipped.size(), 1u);
  EXPECT_EQ(test::read(document).skipped[0],
            "extensions that are not used: KHR_texture_basisu, KHR_materials_clearcoat");
}

}  // namespace
}  // namespace nightcity
