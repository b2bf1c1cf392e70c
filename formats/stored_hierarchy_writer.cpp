#include "formats/stored_hierarchy_writer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_document.h"
#include "formats/gltf_stream.h"
#include "formats/json_text.h"
#include "formats/scratch_file.h"

namespace nightcity {
namespace {

using gltf::Json;
using gltf::member;

constexpr std::size_t alignment = 8;

std::size_t find_padding(std::size_t size) {
  return (alignment - size % alignment) % alignment;
}

// This is added behind the binary chunk of a file, and described in its JSON.
struct Addition {
  std::size_t size;  // of the binary chunk, with what is added so far
  std::size_t first_view;
  std::vector<std::span<const std::byte>> parts;
  Json views = Json::array();

  std::size_t add(std::span<const std::byte> bytes) {
    size += find_padding(size);
    views.push_back({{"buffer", 0}, {"byteOffset", size}, {"byteLength", bytes.size()}});
    parts.push_back(bytes);
    size += bytes.size();
    return first_view + views.size() - 1;
  }
};

Json describe_hierarchy(const StoredHierarchy& hierarchy, Addition& addition) {
  Json result = {{"castsShadow", hierarchy.casts_shadow}, {"nodes", hierarchy.nodes},
                 {"triangles", hierarchy.triangles},      {"min", gltf::to_json(hierarchy.lower)},
                 {"max", gltf::to_json(hierarchy.upper)}, {"area", hierarchy.area_m2}};
  if (hierarchy.along != glm::vec2(1, 0))
    result["along"] = {double(hierarchy.along.x), double(hierarchy.along.y)};
  if (!hierarchy.topology.empty()) result["topology"] = addition.add(hierarchy.topology);
  result["order"] = addition.add(hierarchy.order);
  if (!hierarchy.cuts.empty()) result["cuts"] = addition.add(hierarchy.cuts);
  return result;
}

// Writes a document member by member, with some of them replaced: as a whole, the JSON of a large
// city would be in memory once more.
std::string write_root(const Json& root, const Json& replaced, const Json& views) {
  std::string text;
  const auto add = [&text](const std::string& key, const std::string& value) {
    text += (text.empty() ? "{\"" : ",\"") + key + "\":" + value;
  };
  for (const auto& [key, value] : root.items())
    if (key != "bufferViews" && !replaced.contains(key)) add(key, dump(value));
  for (const auto& [key, value] : replaced.items()) add(key, dump(value));
  std::string all = dump(root.at("bufferViews")), more = dump(views);
  all.back() = ',';
  add("bufferViews", all + more.substr(1));
  return text + "}";
}

}  // namespace

bool store_hierarchies(const std::filesystem::path& glb,
                       std::span<const StoredHierarchy> hierarchies) {
  const gltf::Document document(glb);
  const Json& root = document.root();
  if (document.count("buffers") != 1 || document.count("bufferViews") == 0)
    throw Error(glb.string(), "is no .glb with one buffer");
  const std::span<const std::byte> binary = document.buffer(0);
  Addition addition{binary.size(), document.count("bufferViews"), {}, Json::array()};
  Json described = Json::array();
  for (const StoredHierarchy& hierarchy : hierarchies)
    described.push_back(describe_hierarchy(hierarchy, addition));
  addition.size += find_padding(addition.size);

  Json replaced;
  replaced["buffers"] = Json::array({{{"byteLength", addition.size}}});
  replaced["extensions"] = member(root, "extensions");
  replaced["extensions"][gltf::hierarchy] = {{"hierarchies", std::move(described)}};
  replaced["extensionsUsed"] = member(root, "extensionsUsed");
  const Json& used = replaced["extensionsUsed"];
  if (std::find(used.begin(), used.end(), gltf::hierarchy) == used.end())
    replaced["extensionsUsed"].push_back(gltf::hierarchy);
  JsonText text;
  text.add(write_root(root, replaced, addition.views));

  ScratchFile scratch(glb);
  scratch.write(binary.data(), binary.size());
  for (const std::span<const std::byte> part : addition.parts) {
    scratch.align(alignment);
    scratch.write(part.data(), part.size());
  }
  scratch.align(alignment);
  if (gltf::count_glb_bytes(text, scratch.size()) > std::numeric_limits<std::uint32_t>::max())
    return false;
  gltf::write_glb(glb, text, scratch);
  return true;
}

}  // namespace nightcity
