#include "formats/gltf_load.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "formats/error.h"
#include "formats/gltf_constants.h"
#include "formats/mapped_file.h"

namespace nightcity::gltf {
namespace {

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

// The container's lengths, checked here for messages with a place; returns the JSON.
std::span<const std::byte> json_of_glb(const std::string& file, std::span<const std::byte> bytes) {
  if (bytes.size() < 20) throw Error(file, "byte " + std::to_string(bytes.size()), "ends in the header");
  if (word(bytes, 4) != 2)
    throw Error(file, "byte 4", "glTF version " + std::to_string(word(bytes, 4)) + ", not 2");
  if (word(bytes, 8) != bytes.size())
    throw Error(file, "byte " + std::to_string(bytes.size()),
                "file of " + std::to_string(word(bytes, 8)) + " bytes ends here");
  std::span<const std::byte> json;
  for (std::size_t offset = 12; offset < bytes.size();) {
    if (bytes.size() - offset < 8)
      throw Error(file, "byte " + std::to_string(offset), "chunk header is cut off");
    const std::size_t length = word(bytes, offset);
    if (length > bytes.size() - offset - 8)
      throw Error(file, "byte " + std::to_string(offset), "chunk reaches beyond the file");
    if (offset == 12) {
      if (word(bytes, offset + 4) != chunk_json) throw Error(file, "byte 16", "first chunk is not JSON");
      json = bytes.subspan(offset + 8, length);
    }
    offset += 8 + length;
  }
  return json;
}

// tinygltf walks extras and extensions by recursion: a file nested a million deep would end the program.
void check_depth(const std::string& file, std::span<const std::byte> json) {
  constexpr int deepest = 256;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = static_cast<char>(json[i]);
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > deepest)
        throw Error(file, "byte " + std::to_string(i) + " of the JSON", "is nested too deep");
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

// A night scene needs no textures.
bool leave_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                 void*) {
  return true;
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

}  // namespace

tinygltf::Model load(const std::filesystem::path& path) {
  const std::string file = path.string();
  const MappedFile mapped(path);
  const auto bytes = mapped.bytes();
  if (bytes.empty()) throw Error(file, "is empty");
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) throw Error(file, "is over 4 GiB: no glTF");
  const bool binary = bytes.size() >= 4 && word(bytes, 0) == glb_magic;
  const auto json = binary ? json_of_glb(file, bytes) : bytes;
  const auto first =
      std::find_if(json.begin(), json.end(), [](std::byte b) { return static_cast<char>(b) > ' '; });
  if (first == json.end() || static_cast<char>(*first) != '{') throw Error(file, "is not glTF");
  check_depth(file, json);

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(leave_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const std::string folder = path.parent_path().string();
  bool loaded = false;
  try {
    const auto size = static_cast<unsigned>(bytes.size());
    loaded = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                  reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                                  folder)
                    : loader.LoadASCIIFromString(&model, &error, &warning,
                                                 reinterpret_cast<const char*>(bytes.data()), size, folder);
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  if (!loaded) throw Error(file, error.empty() ? "is not glTF" : one_line(error));
  if (model.asset.version.rfind("2.", 0) != 0)
    throw Error(file, "glTF version \"" + model.asset.version + "\", not 2");
  return model;
}

}  // namespace nightcity::gltf
