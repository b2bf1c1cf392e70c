#include "tools/obj/face_pictures.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "tools/city/cut_picture.h"
#include "tools/obj/group_reader.h"

namespace nightcity::obj {

FacePictures::FacePictures(const city::Document& document, const Vertices& vertices,
                           city::Textures textures)
    : vertices_(vertices), textures_(textures) {
  if (document.packed) return;  // its libraries are not read either
  std::vector<std::string> absent, names;
  std::set<std::filesystem::path> read;
  const std::filesystem::path file = document.name;
  for (const std::string& library : vertices.libraries)
    for (const std::filesystem::path& one : find_libraries(file, library, absent)) {
      if (!read.insert(one.lexically_normal()).second) continue;
      std::map<std::string, Material> materials;
      read_materials(one, file.parent_path(), materials);
      for (const auto& [name, material] : materials)
        if (material.texture && numbers_.try_emplace(material.texture->file, names.size()).second)
          names.push_back(material.texture->file);
    }
  shelf_ = std::make_unique<city::PictureShelf>(document.name, std::move(names));
}

void FacePictures::lay(const Texture& texture, const std::vector<std::uint32_t>& places,
                       city::Polygon& polygon, std::int64_t& pixels_left,
                       city::SkipCounter& skipped) const {
  const auto number = numbers_.find(texture.file);
  if (!shelf_ || number == numbers_.end())
    return skipped.add("texture: its picture is not in the list");
  if (std::find(places.begin(), places.end(), no_place) != places.end())
    return skipped.add("texture: a place in its picture that is not there");
  const char* why = nullptr;
  const auto picture = shelf_->find(number->second, why);
  if (!picture) return skipped.add(why);
  std::vector<glm::dvec2> on_picture;
  for (const std::uint32_t place : places)
    on_picture.push_back(glm::dvec2(vertices_.texture_places[place]) * texture.scale +
                         texture.offset);
  city::lay_picture(*picture, on_picture, textures_, polygon, pixels_left, skipped);
}

}  // namespace nightcity::obj
