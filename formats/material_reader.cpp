#include "formats/material_reader.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/gltf_constants.h"
#include "formats/gltf_numbers.h"

namespace nightcity {
namespace {

using gltf::extension;
using gltf::Json;
using gltf::member;
using gltf::numbers;

constexpr std::size_t max_coordinate_set = 1000;  // files have two or three

TextureWrap to_wrap(std::optional<std::size_t> number) {
  return number == gltf::wrap_clamp    ? TextureWrap::clamp
         : number == gltf::wrap_mirror ? TextureWrap::mirror
                                       : TextureWrap::repeat;
}

bool in_range(const glm::vec3& value) {
  return finite(value) && value.x >= 0 && value.y >= 0 && value.z >= 0;
}

}  // namespace

SceneMaterial MaterialReader::read(std::size_t index) {
  const Json& source = document_.element("materials", index);
  const Json& surface = member(source, "pbrMetallicRoughness");
  const Json& specular = extension(source, gltf::specular_glossiness);
  // The diffuse colour of the older model is what this renderer needs: a reflectance without the
  // mirrored part.
  const bool older = specular.is_object();
  const Json& model = older ? specular : surface;
  const std::string alpha_mode = gltf::text(source, "alphaMode");
  const bool transparent = !alpha_mode.empty() && alpha_mode != "OPAQUE";
  specular_ += older;
  transparent_ += transparent;

  const auto colour = numbers(model, older ? "diffuseFactor" : "baseColorFactor", {1, 1, 1, 1});
  const auto emission = numbers(source, "emissiveFactor", {0, 0, 0});
  const double strength =
      gltf::number(extension(source, gltf::emissive_strength), "emissiveStrength", 1);
  const glm::dvec3 light = glm::dvec3(emission[0], emission[1], emission[2]) * strength;
  SceneMaterial result;
  result.name = gltf::text(source, "name");
  const glm::dvec3 factor(colour[0], colour[1], colour[2]);
  const Json& picture = member(model, older ? "diffuseTexture" : "baseColorTexture");
  result.base_colour = factor * find_mean(picture, transparent);
  // No surface reflects more than falls on it.
  too_bright_ += factor.x > 1 || factor.y > 1 || factor.z > 1;
  result.base_colour = glm::min(result.base_colour, glm::vec3(1));
  unlit_ += extension(source, "KHR_materials_unlit").is_object();
  metal_ += !older && gltf::number(surface, "metallicFactor", 0) > 0.5;
  // A material that does not shine needs no look at its picture.
  const Json none;
  result.emission_cd_m2 =
      light * find_mean(light == glm::dvec3(0) ? none : member(source, "emissiveTexture"), false);
  result.roughness = static_cast<float>(older ? 1 - gltf::number(specular, "glossinessFactor", 1)
                                              : gltf::number(surface, "roughnessFactor", 1));
  result.double_sided = gltf::boolean(source, "doubleSided", false);
  // A material that shines or is cut out keeps the mean: other rules make its colour.
  if (!transparent && light == glm::dvec3(0) && in_range(factor)) {
    result.texture = find_texture(picture);
    if (result.texture) result.texture->factor = glm::min(factor, glm::dvec3(1));
  }
  count_other_textures(source);
  for (const glm::vec3& value :
       {result.base_colour, result.emission_cd_m2, glm::vec3(result.roughness)})
    if (!in_range(value))
      throw Error("", "material " + std::to_string(index), "a value is negative or not finite");
  return result;
}

void MaterialReader::count_other_textures(const Json& source) {
  const Json& surface = member(source, "pbrMetallicRoughness");
  const Json& specular = extension(source, gltf::specular_glossiness);
  for (const Json* texture : {&member(source, "normalTexture"), &member(source, "occlusionTexture"),
                              &member(surface, "metallicRoughnessTexture"),
                              &member(specular, "specularGlossinessTexture")})
    other_textures_ += texture->is_object();
}

glm::dvec3 MaterialReader::find_mean(const Json& info, bool use_alpha) {
  const auto texture = gltf::index(info, "index");
  if (!texture) return glm::dvec3(1);
  std::optional<glm::dvec3> mean;
  std::string reason;
  try {
    const auto image = gltf::index(document_.element("textures", *texture), "source");
    if (!image) throw Error("", "is in a format that only an extension of glTF knows");
    const auto [found, added] = means_.try_emplace({*image, use_alpha});
    if (added) found->second = read_mean(*image, use_alpha);
    mean = found->second;
    if (!mean) reason = "image " + std::to_string(*image) + " cannot be read";
  } catch (const Error& error) {
    reason = "texture " + std::to_string(*texture) + ": " + error.what();
  }
  if (mean) {
    ++averaged_;
    return *mean;
  }
  if (unread_++ == 0) unread_reason_ = reason;
  return glm::dvec3(1);
}

std::optional<SceneTexture> MaterialReader::find_texture(const Json& info) {
  const auto index = gltf::index(info, "index");
  if (!index || extension(info, gltf::texture_transform).is_object()) return {};
  if (*index >= document_.count("textures")) return {};
  const Json& texture = document_.element("textures", *index);
  const auto image = gltf::index(texture, "source");
  if (!image) return {};
  const auto mean = means_.find({*image, false});
  if (mean == means_.end() || !mean->second) return {};
  const auto coordinates = gltf::index(info, "texCoord").value_or(0);
  if (coordinates > max_coordinate_set) return {};
  const auto [at, is_new] =
      picture_of_image_.try_emplace(*image, static_cast<std::uint32_t>(pictures_.size()));
  if (is_new) {
    const auto bytes = find_bytes(*image);
    pictures_.emplace_back(bytes.begin(), bytes.end());
  }
  SceneTexture result{.picture = at->second};
  result.coordinates = static_cast<std::uint32_t>(coordinates);
  if (const auto sampler = gltf::index(texture, "sampler");
      sampler && *sampler < document_.count("samplers")) {
    const Json& source = document_.element("samplers", *sampler);
    result.wrap_u = to_wrap(gltf::index(source, "wrapS"));
    result.wrap_v = to_wrap(gltf::index(source, "wrapT"));
  }
  --averaged_;
  return result;
}

std::span<const std::byte> MaterialReader::find_bytes(std::size_t image) {
  const Json& source = document_.element("images", image);
  const std::string uri = gltf::text(source, "uri");
  const auto view = gltf::index(source, "bufferView");
  if (uri.empty() && !view) throw Error("", "image " + std::to_string(image), "names no picture");
  return uri.empty() ? accessors_.view(*view) : document_.file(uri);
}

glm::dvec3 MaterialReader::read_mean(std::size_t image, bool use_alpha) {
  const Json& source = document_.element("images", image);
  const std::string uri = gltf::text(source, "uri");
  const auto bytes = find_bytes(image);
  if (!budget_.take(bytes))
    throw Error("", "image " + std::to_string(image),
                std::string("is not unpacked: ") + picture_budget_text);
  const auto mean = find_picture_mean(bytes, use_alpha);
  if (!mean)
    throw Error("", "image " + std::to_string(image) + (uri.empty() ? "" : " (" + uri + ")"),
                "is no PNG or JPEG that can be read, or has more than 8192 x 8192 pixels");
  return *mean;
}

std::vector<std::string> MaterialReader::describe_skipped() const {
  std::vector<std::string> sentences;
  const auto say = [&](std::size_t count, const char* one, const char* many,
                       const std::string& rest) {
    if (count != 0) sentences.push_back(std::to_string(count) + (count == 1 ? one : many) + rest);
  };
  say(averaged_, " texture is", " textures are",
      " shown as one colour, the mean of the whole picture");
  say(unread_, " texture is", " textures are",
      " not read (" + unread_reason_ +
          "): these surfaces have the colour that the texture would multiply");
  say(other_textures_, " texture of normals, occlusion or roughness is",
      " textures of normals, occlusion or roughness are", " not used");
  say(specular_, " material has", " materials have",
      " specular and glossy parts (KHR_materials_pbrSpecularGlossiness) of which the diffuse "
      "colour is used and the specular colour is not");
  say(too_bright_, " material reflects", " materials reflect",
      " more than falls on it: 1 is taken");
  say(unlit_, " material is", " materials are",
      " to be shown without light (KHR_materials_unlit), and lit here as others");
  say(metal_, " material is", " materials are", " metal, and shown matt with the same reflectance");
  say(transparent_, " material is", " materials are",
      " cut out or transparent (alphaMode), and shown opaque");
  return sentences;
}

}  // namespace nightcity
