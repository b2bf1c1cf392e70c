// A glTF file while it is written: what grows with the city goes to scratch files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "formats/json_text.h"
#include "formats/scratch_file.h"

namespace nightcity::gltf {

/// Returns the description of an accessor over `count` values of `type` ("SCALAR", "VEC3", ...).
nlohmann::json make_accessor(int component_type, const char* type, std::size_t count);
nlohmann::json to_json(const glm::dvec3& vector);
nlohmann::json to_json(const glm::dquat& rotation);

/// The binary chunk, and the arrays of the JSON chunk that point into it.
struct Stream {
  explicit Stream(const std::filesystem::path& target)
      : binary(target), accessors(target), views(target) {}

  // All functions return the index of what they add. `target` is a buffer view's target
  // (gltf_constants.h), 0 for none.
  std::size_t add_view(std::uint64_t offset, std::uint64_t size, int target = 0);
  template <class T>
  std::size_t write_view(std::span<const T> data, int target = 0) {
    binary.align(4);
    const std::uint64_t offset = binary.size();
    binary.write(data.data(), data.size_bytes());
    return add_view(offset, data.size_bytes(), target);
  }
  /// Without `view` the values are in an extension's data (Draco).
  std::size_t add_accessor(nlohmann::json accessor, std::optional<std::size_t> view);

  ScratchFile binary;
  JsonArray accessors, views;
  std::set<std::string> extensions_used, extensions_required;
};

/// Returns the size of the file that write_glb would write, whose binary chunk has so many bytes.
std::uint64_t count_glb_bytes(const JsonText& json, std::uint64_t binary_size);

/// Writes the file: `json` is padded so that the binary chunk starts on a multiple of 8, for
/// readers that map the file. Throws Error if it would be larger than the 4 GiB that a .glb may
/// hold.
void write_glb(const std::filesystem::path& path, JsonText& json, ScratchFile& binary);

}  // namespace nightcity::gltf
