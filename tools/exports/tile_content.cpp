#include "tools/exports/tile_content.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <map>
#include <utility>

#include "formats/rgb9e5.h"
#include "formats/scene_writer.h"
#include "formats/schedule.h"
#include "tools/bake/scene/punctual.h"
#include "tools/exports/ies_text.h"
#include "tools/exports/light_texts.h"

namespace nightcity::exports {
namespace {

class TileWriter {
 public:
  TileWriter(const Scene& scene, const LightFile* lights, const glm::dvec3& origin,
             const std::filesystem::path& path, LampForm form)
      : scene_(scene), lights_(lights), origin_(origin), form_(form), writer_(path, {}) {}

  void add_parts(const std::vector<TileParts::Part>& parts) {
    // Luminous parts of lamps become meshes with a feature each; what stands in many places
    // otherwise stays instanced.
    std::map<std::size_t, std::vector<std::size_t>> by_node;
    for (const TileParts::Part& part : parts) by_node[part.node].push_back(part.instance);
    for (const auto& [number, instances] : by_node) {
      const SceneNode& node = scene_.nodes[number];
      SceneNode rest = node;
      rest.instances.clear();
      for (const std::size_t i : instances) {
        SceneInstance instance = node.instances[i];
        for (int axis = 0; axis < 3; ++axis)
          instance.to_model[3][axis] =
              static_cast<float>(instance.to_model[3][axis] - origin_[axis]);
        instance.feature = to_feature(instance.feature);
        if (instance.light == no_id)
          rest.instances.push_back(instance);
        else
          add_luminous(node, instance);
      }
      if (rest.instances.empty()) continue;
      rest.mesh = add_mesh(node.mesh);
      writer_.add_node(rest);
    }
    write_luminous();
  }

  void add_lamp(const Light& light) {
    const std::uint32_t profile = light_profile(light);
    if (form_ == LampForm::ies && light_kind(light) == LightKind::sphere &&
        profile < lights_->profiles().size())
      return add_ies_lamp(light, profile);
    ScenePunctual punctual = bake::to_punctual(light, lights_->profiles(), lights_->profile_data());
    punctual.position = glm::vec3(glm::dvec3(light.position) - origin_);
    writer_.add_punctual(punctual);
  }

  SceneStatistics finish() {
    Georeference place = scene_.georeference;
    place.origin = scene_.georeference.from_model(origin_);
    writer_.finish(place);
    return writer_.statistics();
  }

 private:
  void add_ies_lamp(const Light& light, std::uint32_t profile) {
    const auto [known, is_new] = ies_profiles_.try_emplace(profile, 0);
    if (is_new)
      known->second = writer_.add_ies_profile(
          to_ies_text(lights_->profiles()[profile], lights_->profile_data()));
    writer_.add_ies_light({known->second, glm::vec3(glm::dvec3(light.position) - origin_),
                           light.axis, light.tangent, decode_rgb9e5(light.colour_rgb9e5),
                           double{light.flux_lm} / ies_flux_lm});
  }

  std::uint32_t to_material(std::uint32_t material) {
    const auto [known, is_new] = materials_.try_emplace(material, 0);
    if (!is_new) return known->second;
    SceneMaterial own = scene_.materials[material];
    if (own.texture) own.texture->picture = to_picture(own.texture->picture);
    return known->second = writer_.add_material(own);
  }

  std::uint32_t to_picture(std::uint32_t picture) {
    const auto [known, is_new] = pictures_.try_emplace(picture, 0);
    if (is_new) known->second = writer_.add_picture(scene_.pictures.at(picture));
    return known->second;
  }

  std::uint32_t to_feature(std::uint32_t feature) {
    if (feature == no_id || feature >= scene_.features.size()) return no_id;
    const auto [known, is_new] = features_.try_emplace(feature, 0);
    if (is_new) known->second = writer_.add_feature(scene_.features[feature]);
    return known->second;
  }

  // Returns the feature of a light: its identity, its use and where its values come from.
  std::uint32_t to_light_feature(std::uint32_t light) {
    if (!lights_ || light >= lights_->lights().size()) return no_id;
    const auto [known, is_new] = light_features_.try_emplace(light, 0);
    if (!is_new) return known->second;
    const LightProvenance from =
        light < lights_->provenance().size() ? lights_->provenance()[light] : LightProvenance{};
    SceneFeature feature;
    feature.id = fmt::format("{:08x}", lights_->lights()[light].id);
    feature.type = name_of(static_cast<LightFamily>(from.family));
    feature.function = fmt::format("{:.0f} lm, {}", lights_->lights()[light].flux_lm,
                                   describe_hours(*lights_, lights_->lights()[light]));
    feature.provenance = describe_provenance(from);
    return known->second = writer_.add_feature(feature);
  }

  std::uint32_t add_mesh(std::uint32_t number) {
    const auto [known, is_new] = meshes_.try_emplace(number, 0);
    if (!is_new) return known->second;
    SceneMesh mesh = scene_.meshes[number];
    for (ScenePrimitive& primitive : mesh.primitives) {
      primitive.material = to_material(primitive.material);
      for (std::uint32_t& feature : primitive.feature_ids) feature = to_feature(feature);
      if (!primitive.light_ids.empty()) {
        primitive.feature_ids.resize(primitive.light_ids.size(), no_id);
        for (std::size_t i = 0; i < primitive.light_ids.size(); ++i)
          if (const std::uint32_t feature = to_light_feature(primitive.light_ids[i]);
              feature != no_id)
            primitive.feature_ids[i] = feature;
        primitive.light_ids.clear();  // they count in city.lights, which is not here
      }
    }
    return known->second = writer_.add_mesh(mesh);
  }

  void add_luminous(const SceneNode& node, const SceneInstance& instance) {
    const std::uint32_t feature = to_light_feature(instance.light);
    for (const ScenePrimitive& primitive : scene_.meshes[node.mesh].primitives) {
      ScenePrimitive& all = luminous_[{node.name, to_material(primitive.material)}];
      const auto first = static_cast<std::uint32_t>(all.positions.size());
      for (const glm::vec3& p : primitive.positions) {
        all.positions.push_back(glm::vec3(instance.to_model * glm::vec4(p, 1)));
        all.feature_ids.push_back(feature);
      }
      for (const std::uint32_t i : primitive.indices) all.indices.push_back(first + i);
    }
  }

  void write_luminous() {
    for (auto& [key, primitive] : luminous_) {
      primitive.material = key.second;
      SceneNode node;
      node.name = key.first;
      node.kind = "lamp";
      node.casts_shadow = false;
      node.mesh = writer_.add_mesh({key.first, {std::move(primitive)}});
      node.instances.emplace_back();
      writer_.add_node(node);
    }
  }

  const Scene& scene_;
  const LightFile* lights_;
  glm::dvec3 origin_;
  LampForm form_;
  SceneWriter writer_;
  std::map<std::uint32_t, std::uint32_t> ies_profiles_, materials_, pictures_, features_,
      light_features_, meshes_;
  std::map<std::pair<std::string, std::uint32_t>, ScenePrimitive> luminous_;  // by name, material
};

}  // namespace

void ModelBox::add(const glm::dvec3& p) {
  least = glm::min(least, p);
  greatest = glm::max(greatest, p);
}

void write_tile(const Scene& scene, const LightFile* lights, const TileParts& tile,
                const glm::dvec3& origin, const std::filesystem::path& path,
                const TilesetOptions& options, TilesetReport& report) {
  TileWriter writer(scene, lights, origin, path, options.lamps);
  writer.add_parts(tile.parts);
  const double time_s = night_begin_s + 60.0 * options.shown_minute;
  for (const std::size_t lamp : tile.lamps) {
    const Light& light = lights->lights()[lamp];
    if (light.schedule != LIGHT_ALWAYS_ON &&
        !is_lit(lights->schedules()[light.schedule], lights->switches(), time_s))
      continue;
    writer.add_lamp(light);
    ++report.lights;
  }
  const SceneStatistics statistics = writer.finish();
  ++report.tiles;
  report.triangles += statistics.triangles;
  report.features += statistics.features;
}

}  // namespace nightcity::exports
