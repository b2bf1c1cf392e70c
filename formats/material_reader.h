// Reads the materials of glTF files. Each has one colour, the mean of its texture, and the texture
// itself where that is one of colour alone.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/gltf_accessor.h"
#include "formats/gltf_document.h"
#include "formats/picture_mean.h"
#include "formats/scene.h"

namespace nightcity {

class MaterialReader {
 public:
  /// Both must outlive the reader. `document` maps the images that materials refer to.
  MaterialReader(gltf::Document& document, const gltf::AccessorReader& accessors)
      : document_(document), accessors_(accessors) {}

  /// Returns a material of the file. Throws Error, without a file name, if a value is negative, not
  /// finite or of a wrong type. A texture that cannot be read is no error: the material keeps the
  /// colour that the texture would multiply.
  SceneMaterial read(std::size_t index);

  /// Returns the pictures of the textures of the materials read so far, and forgets them.
  std::vector<ScenePicture> take_pictures() { return std::move(pictures_); }

  /// Returns what the materials read so far hold that the scene does not show as it is, one
  /// sentence for each kind.
  std::vector<std::string> describe_skipped() const;

 private:
  /// Returns the mean colour of a texture (linear Rec. 709), white where there is none.
  glm::dvec3 find_mean(const gltf::Json& texture, bool use_alpha);
  glm::dvec3 read_mean(std::size_t image, bool use_alpha);
  std::span<const std::byte> find_bytes(std::size_t image);
  /// Returns the texture itself, where `info` names one that find_mean could read and that lies on
  /// its surfaces as it is.
  std::optional<SceneTexture> find_texture(const gltf::Json& info);
  void count_other_textures(const gltf::Json& source);

  gltf::Document& document_;
  const gltf::AccessorReader& accessors_;
  // By image and whether alpha counts; nothing: the image cannot be read.
  std::map<std::pair<std::size_t, bool>, std::optional<glm::dvec3>> means_;
  std::map<std::size_t, std::uint32_t> picture_of_image_;
  std::vector<ScenePicture> pictures_;
  PictureBudget budget_;
  std::size_t averaged_ = 0, unread_ = 0, other_textures_ = 0, specular_ = 0, transparent_ = 0,
              too_bright_ = 0, unlit_ = 0, metal_ = 0;
  std::string unread_reason_;  // of the first
};

}  // namespace nightcity
