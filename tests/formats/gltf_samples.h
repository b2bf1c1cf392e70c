// Small glTF files as other programs write them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "formats/error.h"
#include "formats/scene_reader.h"
#include "support/temp_folder.h"

namespace nightcity::test {

using nlohmann::json;

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63u];
  }
  return text;
}

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(T)};
}

// The four corners of a square, then its indices 0 1 2 3 in 8 bits each.
inline json foreign(std::string data = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) +
                                       bytes_of<std::uint8_t>({0, 1, 2, 3})) {
  return {{"asset", {{"version", "2.0"}}},
          {"buffers",
           {{{"byteLength", data.size()},
             {"uri", "data:application/octet-stream;base64," + base64(data)}}}},
          {"bufferViews",
           {{{"buffer", 0}, {"byteLength", 48}},
            {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 4}}}},
          {"accessors",
           {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
            {{"bufferView", 1}, {"componentType", 5121}, {"count", 4}, {"type", "SCALAR"}}}},
          {"meshes",
           {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"mode", 5}}}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"scenes", {{{"nodes", {0}}}}},
          {"scene", 0}};
}

inline Scene read(const json& document) {
  const TempFolder folder;
  write_text(folder / "file.gltf", document.dump());
  return read_scene(folder / "file.gltf");
}

/// Returns the message with which `document` is refused; empty if it is read.
inline std::string refusal(const json& document) {
  try {
    read(document);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Adds a bufferView of these bytes, in a buffer of its own, and returns its index.
inline std::size_t add_view(json& document, const std::string& data) {
  document["buffers"].push_back({{"byteLength", data.size()},
                                 {"uri", "data:application/octet-stream;base64," + base64(data)}});
  document["bufferViews"].push_back(
      {{"buffer", document["buffers"].size() - 1}, {"byteLength", data.size()}});
  return document["bufferViews"].size() - 1;
}

}  // namespace nightcity::test
