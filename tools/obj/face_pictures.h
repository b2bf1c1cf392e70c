// The pictures that an OBJ's libraries of colours lay on its faces (map_Kd).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"
#include "tools/city/picture_shelf.h"
#include "tools/city/skip_counter.h"
#include "tools/obj/materials.h"
#include "tools/obj/vertices.h"

namespace nightcity::obj {

/// Safe to use from several threads.
class FacePictures {
 public:
  /// Looks at all libraries that the file names, so that the budget of pictures does not depend on
  /// who asks first.
  FacePictures(const city::Document& document, const Vertices& vertices, city::Textures textures);

  /// Gives a polygon the mean of its part of the material's picture as its colour and, with
  /// Textures::atlas, the part itself. `places`: one for each vertex of the exterior, places in
  /// `vertices` or no_place. What cannot be laid on it is counted in `skipped`.
  void lay(const Texture& texture, const std::vector<std::uint32_t>& places, city::Polygon& polygon,
           std::int64_t& pixels_left, city::SkipCounter& skipped) const;

 private:
  const Vertices& vertices_;
  city::Textures textures_;
  std::map<std::string, std::size_t> numbers_;
  std::unique_ptr<city::PictureShelf> shelf_;
};

}  // namespace nightcity::obj
