// A glTF file opened: its JSON and its buffers. Debian's TinyGLTF is not used for reading: built without
// Draco, it refuses every file whose indices are compressed, and it copies the whole file where a mapping
// does.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/mapped_file.h"

namespace nightcity::gltf {

using Json = nlohmann::json;

/// Buffers are mapped, not copied (data URIs are decoded); images stay unread.
class Document {
 public:
  /// Reads .glb or .gltf (by content, not by name). Throws Error: missing, empty, truncated, not glTF 2, a
  /// buffer that is missing or too short.
  explicit Document(const std::filesystem::path& path);

  const Json& root() const { return root_; }
  /// Element `index` of the top-level array `name`; throws Error where there is none.
  const Json& element(const char* name, std::size_t index) const;
  /// How many elements the top-level array `name` has.
  std::size_t count(const char* name) const;
  std::span<const std::byte> buffer(std::size_t index) const;

 private:
  void read_json(std::span<const std::byte> bytes);
  void read_container(std::span<const std::byte> bytes);
  void read_buffers(const std::filesystem::path& folder);
  std::span<const std::byte> external(const std::string& uri, const std::filesystem::path& folder);

  std::string name_;
  Json root_;
  std::deque<MappedFile> files_;
  std::deque<std::vector<std::byte>> decoded_;
  std::optional<std::span<const std::byte>> binary_chunk_;
  std::vector<std::span<const std::byte>> buffers_;
};

/// Member `key` of an object; null where the object has none or is no object.
const Json& member(const Json& object, const char* key);
/// Object `name` of the extensions of a node, mesh, material, ...; null where there is none.
const Json& extension(const Json& object, const char* name);
/// A whole number >= 0; empty where the member is absent. Throws Error where it is anything else.
std::optional<std::size_t> index(const Json& object, const char* key);
/// A number, or `otherwise` where the member is absent. Throws Error where it is anything else.
double number(const Json& object, const char* key, double otherwise);
std::string text(const Json& object, const char* key);
bool boolean(const Json& object, const char* key, bool otherwise);

}  // namespace nightcity::gltf
