// A glTF file: its JSON and its buffers. Debian's TinyGLTF is not used for reading: built without
// Draco, it refuses files whose indices are compressed, and it copies the whole file, which a
// mapping need not.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/scene_bytes.h"

namespace nightcity::gltf {

using Json = nlohmann::json;

/// Buffers are mapped, not copied, except data URIs, which are decoded.
class Document {
 public:
  /// Opens a .glb or a .gltf; the content decides, not the name. Throws Error if the file is
  /// missing, empty, truncated or not glTF 2, or if a buffer is missing or too short. Where the
  /// file is something else that is known, the message says what, and the remedy.
  explicit Document(const std::filesystem::path& path);

  const Json& root() const { return root_; }
  /// Returns element `index` of the top-level array `name`. Throws Error if there is none.
  const Json& element(const char* name, std::size_t index) const;
  /// Returns the number of elements of the top-level array `name`, 0 if it is absent.
  std::size_t count(const char* name) const;
  std::span<const std::byte> buffer(std::size_t index) const;
  /// Returns the bytes of a file that the scene names by `uri` (an image), as long as the document
  /// lives. Throws Error, without a file name, if it is missing or not beside the scene.
  std::span<const std::byte> file(const std::string& uri);
  /// Returns the number of bytes of all files that belong to the scene.
  std::size_t bytes() const;
  /// Moves the JSON to `json`, root() is null then, and returns the files, which buffers lie in.
  std::shared_ptr<const SceneBytes> take_files(Json& json);
  void release_pages() const { files_->release_pages(); }

 private:
  void read_json(std::span<const std::byte> bytes);
  void read_container(std::span<const std::byte> bytes);
  void check_version() const;
  void read_buffers(const std::filesystem::path& folder);
  std::span<const std::byte> external(const std::string& uri, const std::filesystem::path& folder);

  std::string name_;
  Json root_;
  std::shared_ptr<SceneBytes> files_ = std::make_shared<SceneBytes>();
  std::optional<std::span<const std::byte>> binary_chunk_;
  std::vector<std::span<const std::byte>> buffers_;
};

/// Returns member `key` of an object, null if it has none or is no object.
const Json& member(const Json& object, const char* key);
/// Returns extension `name` of a node, mesh, material, ..., null if there is none.
const Json& extension(const Json& object, const char* name);
/// Returns a whole number >= 0, nothing if the member is absent. Throws Error if it is anything
/// else.
std::optional<std::size_t> index(const Json& object, const char* key);
// These return `otherwise` (text: "") if the member is absent, and throw Error if it has another
// type.
double number(const Json& object, const char* key, double otherwise);
std::string text(const Json& object, const char* key);
bool boolean(const Json& object, const char* key, bool otherwise);

}  // namespace nightcity::gltf
