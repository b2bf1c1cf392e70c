// Textures of surfaces (app:ParameterizedTexture): their mean colours, and their pictures.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/picture_mean.h"
#include "tools/city/city_reader.h"
#include "tools/city/cut_picture.h"
#include "tools/city/skip_counter.h"
#include "tools/citygml/appearances.h"
#include "tools/citygml/picture_plan.h"

namespace nightcity::citygml {

/// The pictures beside one document. Safe to use from several threads.
class PictureColours {
 public:
  /// Pictures lie beside `document`, whose text is in Latin-1 or UTF-8; others are not read.
  /// With Textures::atlas pictures are kept for the polygons that they lie on.
  PictureColours(const city::Document& document, bool latin1, city::Textures textures);

  /// Calls `take(id, colour)` for each target of the texture: the mean of the picture's part that
  /// its texture coordinates span, as sRGB from 0 to 1 in 32 steps a channel, since each colour
  /// becomes a material. Pictures that are absent, elsewhere, none or beyond the budget of the
  /// document's pictures are counted in `skipped`.
  /// `take_ring(id, texture)` is called for each ring that has coordinates in a picture that is
  /// there, where pictures are kept.
  void read(const pugi::xml_node& texture, city::SkipCounter& skipped,
            const std::function<void(std::string_view, const glm::vec3&)>& take,
            const std::function<void(std::string_view, RingTexture&&)>& take_ring);

  bool keeps_pictures() const { return textures_ == city::Textures::atlas; }
  /// Returns the picture of that number (RingTexture); null where it can no longer be read.
  std::shared_ptr<const Picture> find_picture(std::uint32_t number);
  void count_laid_out() { ++laid_out_; }
  std::size_t laid_out() const { return laid_out_; }  // polygons that have their picture
  std::size_t surfaces() const { return surfaces_; }

 private:
  std::shared_ptr<const Picture> find_picture(std::string_view uri, const char*& why);
  std::uint32_t find_number(std::string_view uri);

  city::Textures textures_;
  std::filesystem::path folder_;
  PicturePlan plan_;
  std::mutex mutex_;
  RecentPictures<std::shared_ptr<const Picture>> recent_;
  std::vector<std::string> uris_;
  std::unordered_map<std::string, std::uint32_t> numbers_;  // of uris_
  std::atomic<std::size_t> surfaces_{0}, laid_out_{0};
};

/// The texture on all rings of a polygon, put together ring by ring.
class PolygonTexture {
 public:
  /// `texture`: of the ring, which has so many vertices; null: it has none. Of the coordinates, the
  /// closing one is left out as it is of the vertices.
  void add(const RingTexture* texture, std::size_t vertices);
  bool is_whole() const { return is_whole_ && !places_.empty(); }
  /// Returns whether a ring has another number of coordinates than of vertices.
  bool is_misfit() const { return is_misfit_; }
  /// Returns what lies on the polygon; null, and counted, where cut_picture returns nothing.
  std::shared_ptr<const city::SurfacePicture> cut(PictureColours& pictures,
                                                  city::SkipCounter& skipped,
                                                  std::int64_t& pixels_left) const;

 private:
  std::uint32_t picture_ = 0;
  std::vector<glm::dvec2> places_;
  bool is_whole_ = true, is_misfit_ = false;
};

}  // namespace nightcity::citygml
