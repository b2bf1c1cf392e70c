#include "formats/skipped_content.h"

#include <algorithm>
#include <set>

#include "formats/error.h"
#include "formats/foreign_file.h"
#include "formats/gltf_constants.h"

namespace nightcity {
namespace {

using gltf::extension;
using gltf::Json;
using gltf::member;

// Extensions that are read, or that change nothing that is shown.
const std::set<std::string>& known_extensions() {
  static const std::set<std::string> names{
      gltf::draco,           gltf::emissive_strength, gltf::gpu_instancing,
      gltf::mesh_features,   gltf::instance_features, gltf::structural_metadata,
      gltf::lights_punctual, gltf::hierarchy,         gltf::specular_glossiness,
      "KHR_materials_unlit", "KHR_mesh_quantization", gltf::texture_transform,
      "KHR_xmp_json_ld"};
  return names;
}

// Without these a surface looks another way, but it is where it belongs: a file may require them.
bool changes_looks_only(const std::string& name) {
  static const std::set<std::string> textures{"KHR_texture_basisu", "EXT_texture_webp",
                                              "EXT_texture_avif", "MSFT_texture_dds"};
  return textures.contains(name) || name.starts_with("KHR_materials_");
}

std::vector<std::string> names_of(const gltf::Document& document, const char* key) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < document.count(key); ++i) {
    const Json& name = document.element(key, i);
    names.push_back(name.is_string() ? name.get<std::string>() : name.dump());
  }
  return names;
}

bool is_zero(const Json& weight) {
  return weight.is_number() && weight.get<double>() == 0;
}

// glTF 2.0, section 3.7.2.2: without weights a mesh has the shape of its attributes.
bool has_weights(const Json& source) {
  const Json& weights = member(source, "weights");
  return weights.is_array() && !std::all_of(weights.begin(), weights.end(), is_zero);
}

struct Counts {
  std::size_t skins = 0, morphs = 0, punctual = 0, points_and_lines = 0, placeless = 0, partial = 0;
  std::string names_of_placeless;  // where the first of them are
};

// "mesh 3 (Roof), primitive 0"
std::string describe_place(std::size_t number, const Json& mesh, std::size_t primitive) {
  const Json& name = member(mesh, "name");
  return "mesh " + std::to_string(number) +
         (name.is_string() ? " (" + name.get<std::string>() + ")" : "") + ", primitive " +
         std::to_string(primitive);
}

// Returns whether a list of triangles has one or two corners beyond its last triangle.
bool has_partial_triangle(const gltf::Document& document, const Json& primitive) {
  auto accessor = gltf::index(primitive, "indices");
  if (!accessor) accessor = gltf::index(member(primitive, "attributes"), "POSITION");
  if (!accessor || *accessor >= document.count("accessors")) return false;
  return gltf::index(document.element("accessors", *accessor), "count").value_or(0) % 3 != 0;
}

Counts count(const gltf::Document& document) {
  Counts counts;
  for (std::size_t i = 0; i < document.count("nodes"); ++i) {
    const Json& node = document.element("nodes", i);
    counts.skins += !member(node, "skin").is_null();
    counts.morphs += has_weights(node);
    counts.punctual += extension(node, gltf::lights_punctual).is_object();
  }
  constexpr std::size_t mode_triangles = 4;
  for (std::size_t i = 0; i < document.count("meshes"); ++i) {
    const Json& mesh = document.element("meshes", i);
    counts.morphs += has_weights(mesh);
    std::size_t number = 0;
    for (const Json& primitive : member(mesh, "primitives")) {
      const std::size_t own = number++;
      const std::size_t mode = gltf::index(primitive, "mode").value_or(mode_triangles);
      counts.partial += mode == mode_triangles && has_partial_triangle(document, primitive);
      if (mode < mode_triangles) {
        ++counts.points_and_lines;
      } else if (!gltf::index(member(primitive, "attributes"), "POSITION")) {
        constexpr std::size_t named = 3;
        std::string& names = counts.names_of_placeless;
        if (counts.placeless < named)
          names += (names.empty() ? "" : "; ") + describe_place(i, mesh, own);
        if (counts.placeless == named) names += "; ...";
        ++counts.placeless;
      }
    }
  }
  return counts;
}

}  // namespace

void check_required_extensions(const gltf::Document& document) {
  for (const std::string& name : names_of(document, "extensionsRequired"))
    if (!known_extensions().contains(name) && !changes_looks_only(name))
      throw Error("", "extensionsRequired", describe_required_extension(name));
}

std::vector<std::string> describe_skipped(const gltf::Document& document, bool baked) {
  std::vector<std::string> sentences;
  const auto say = [&](std::size_t count, const char* one, const char* many, const char* rest) {
    if (count != 0) sentences.push_back(std::to_string(count) + (count == 1 ? one : many) + rest);
  };
  const Counts counts = count(document);
  say(counts.skins, " node has a skin,", " nodes have skins,",
      " which is not applied: the mesh is shown as it is stored");
  say(counts.morphs, " mesh or node has weights", " meshes or nodes have weights",
      " of morph targets, which are not applied");
  say(document.count("animations"), " animation is", " animations are",
      " not played: the scene stands still");
  say(counts.points_and_lines, " primitive of points or lines has",
      " primitives of points or lines have", " no surface, so nothing of it is seen");
  const std::string of_placeless =
      " no POSITION, so nothing of it is seen: " + counts.names_of_placeless;
  say(counts.placeless, " primitive has", " primitives have", of_placeless.c_str());
  say(counts.partial, " primitive has", " primitives have",
      " corners beyond the last whole triangle, which are left out");
  if (!baked)
    say(counts.punctual, " light is", " lights are",
        " not lit (KHR_lights_punctual): only the .lights file beside a scene shines");
  std::string unknown;
  for (const std::string& name : names_of(document, "extensionsUsed"))
    if (!known_extensions().contains(name)) unknown += (unknown.empty() ? "" : ", ") + name;
  if (!unknown.empty()) sentences.push_back("extensions that are not used: " + unknown);
  return sentences;
}

}  // namespace nightcity
