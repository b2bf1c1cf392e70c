#include "formats/scene_document_reader.h"

#include "formats/error.h"
#include "formats/georeference_json.h"
#include "formats/gltf_constants.h"
#include "formats/scene_node_reader.h"
#include "formats/scene_places_json.h"
#include "formats/skipped_content.h"
#include "formats/stored_hierarchy_reader.h"

namespace nightcity {
namespace {

using gltf::extension;
using gltf::Json;
using gltf::member;

}  // namespace

const Json& find_asset_extras(const gltf::Document& document) {
  return member(member(member(document.root(), "asset"), "extras"), gltf::extras_key);
}

void DocumentReader::read() {
  check_required_extensions(document_);
  const Json& ours = find_asset_extras(document_);
  if (ours.is_object()) {
    scene_.georeference = georeference_from_json(ours);
    scene_.places = places_from_json(ours, place_sentences_);
  }
  read_features();
  read_materials();
  scene_.nodes = NodeReader(document_, accessors_, tables_).read();
  hierarchies_ = read_hierarchies(document_, accessors_, hierarchy_sentences_);
}

void DocumentReader::complete() {
  if (std::exchange(complete_, true)) return;
  add_coloured_materials();
  scene_.skipped = describe_skipped(document_, find_asset_extras(document_).is_object());
  if (const std::size_t count = untextured_)
    scene_.skipped.push_back(std::to_string(count) +
                             (count == 1 ? " primitive has" : " primitives have") +
                             " a texture and no texture coordinates: the mean colour is shown");
  for (auto* sentences :
       {&material_sentences_, &colour_sentences_, &place_sentences_, &hierarchy_sentences_})
    scene_.skipped.insert(scene_.skipped.end(), sentences->begin(), sentences->end());
}

void DocumentReader::read_features() {
  const Json& metadata = extension(document_.root(), gltf::structural_metadata);
  const ViewBytes view = [this](std::size_t index) { return accessors_.view(index); };
  for (std::size_t t = 0; t < member(metadata, "propertyTables").size(); ++t) {
    const auto features = read_feature_table(metadata, t, view);
    tables_.push_back({scene_.features.size(), features.size()});
    scene_.features.insert(scene_.features.end(), features.begin(), features.end());
  }
}

void DocumentReader::read_materials() {
  material_count_ = document_.count("materials");
  for (std::size_t i = 0; i < material_count_; ++i) scene_.materials.push_back(materials_.read(i));
  scene_.pictures = materials_.take_pictures();
  material_sentences_ = materials_.describe_skipped();
  // glTF's default: white, single-sided.
  scene_.materials.push_back({.name = "", .base_colour = glm::vec3(1), .double_sided = false});
}

std::uint32_t DocumentReader::find_material(const Json& source) {
  const std::size_t index = gltf::index(source, "material").value_or(material_count_);
  if (index > material_count_ || (index == material_count_ && source.contains("material")))
    throw Error("", numbered("material", index), "is not there");
  if (index == material_count_) uses_default_ = true;
  return static_cast<std::uint32_t>(index);
}

void DocumentReader::add_coloured_materials() {
  if (const std::size_t count = colours_.primitives()) {
    const auto made = colours_.materials(scene_.materials);
    scene_.materials.insert(scene_.materials.end(), made.begin(), made.end());
    colour_sentences_.push_back(std::to_string(count) +
                                (count == 1 ? " primitive has" : " primitives have") +
                                " colours of vertices, shown as one colour a triangle");
  } else if (!uses_default_) {
    scene_.materials.pop_back();
  }
}

SceneMesh DocumentReader::read_mesh(std::size_t index, MappedMesh* mapped) {
  const Json& source = document_.element("meshes", index);
  const Json& primitives = member(source, "primitives");
  SceneMesh mesh;
  mesh.name = gltf::text(source, "name");
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    try {
      std::vector<glm::vec3> colours;
      auto primitive = primitives_.read(primitives.at(p), tables_, colours);
      if (!primitive) continue;
      primitive->material = find_material(primitives.at(p));
      colours_.apply(*primitive, colours, material_count_ + 1);
      if (primitive->indices.empty()) continue;
      if (const auto& texture = scene_.materials[primitive->material].texture) {
        primitive->texture_coordinates = primitives_.read_texture_coordinates(
            primitives.at(p), texture->coordinates, primitive->positions.size());
        untextured_ += primitive->texture_coordinates.empty();
      }
      if (mapped) {
        mapped->push_back(primitive->texture_coordinates.empty()
                              ? primitives_.find(primitives.at(p), tables_)
                              : std::nullopt);
        if (mapped->back()) mapped->back()->material = primitive->material;
      }
      mesh.primitives.push_back(std::move(*primitive));
    } catch (const Error& error) {
      throw Error("", numbered("mesh", index) + numbered(" primitive", p), error.what());
    }
  }
  return mesh;
}

std::optional<MappedMesh> DocumentReader::map_mesh(std::size_t index, VertexCheck vertices) {
  MappedMesh mesh;
  for (const Json& source : member(document_.element("meshes", index), "primitives")) {
    auto primitive = primitives_.find(source, tables_);
    if (!primitive || !is_fit(*primitive, vertices)) return std::nullopt;
    primitive->material = find_material(source);
    if (scene_.materials[primitive->material].texture) return std::nullopt;
    mesh.push_back(primitive);
  }
  return mesh;
}

}  // namespace nightcity
