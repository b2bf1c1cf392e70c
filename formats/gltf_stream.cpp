#include "formats/gltf_stream.h"

#include <initializer_list>
#include <limits>

#include "formats/error.h"
#include "formats/gltf_constants.h"

namespace nightcity::gltf {
namespace {

constexpr std::uint64_t header_bytes = 12, chunk_header_bytes = 8;

void write_words(AtomicFile& file, std::initializer_list<std::uint32_t> words) {
  for (const std::uint32_t word : words) file.write(&word, sizeof word);
}

// Three headers come before the binary chunk: the file's and one of each chunk.
std::uint64_t count_padding(const JsonText& json) {
  constexpr std::uint64_t headers = header_bytes + 2 * chunk_header_bytes;
  return (8 - (json.size() + headers) % 8) % 8;
}

}  // namespace

nlohmann::json make_accessor(int component_type, const char* type, std::size_t count) {
  return {{"componentType", component_type}, {"type", type}, {"count", count}};
}

nlohmann::json to_json(const glm::dvec3& vector) {
  return {vector.x, vector.y, vector.z};
}

nlohmann::json to_json(const glm::dquat& rotation) {
  return {rotation.x, rotation.y, rotation.z, rotation.w};
}

std::size_t Stream::add_view(std::uint64_t offset, std::uint64_t size, int target) {
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  return views.add(view);
}

std::size_t Stream::add_accessor(nlohmann::json accessor, std::optional<std::size_t> view) {
  if (view) accessor["bufferView"] = *view;
  return accessors.add(accessor);
}

std::uint64_t count_glb_bytes(const JsonText& json, std::uint64_t binary_size) {
  return header_bytes + chunk_header_bytes + json.size() + count_padding(json) +
         (binary_size == 0 ? 0 : chunk_header_bytes + binary_size);
}

void write_glb(const std::filesystem::path& path, JsonText& json, ScratchFile& binary) {
  json.add(std::string(count_padding(json), ' '));
  const std::uint64_t binary_size = binary.size(), total = count_glb_bytes(json, binary_size);
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw Error(path.string(), "the scene needs " + std::to_string(total) +
                                   " bytes, a .glb holds 4 GiB: use Draco or bake fewer files");
  AtomicFile file(path);
  write_words(file, {glb_magic, 2, static_cast<std::uint32_t>(total)});
  write_words(file, {static_cast<std::uint32_t>(json.size()), chunk_json});
  json.write(file);
  if (binary_size != 0) {
    write_words(file, {static_cast<std::uint32_t>(binary_size), chunk_binary});
    binary.copy_to(file);
  }
  file.commit();
}

}  // namespace nightcity::gltf
