// Mean colours of surfaces under their textures (app:ParameterizedTexture).
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
#include <string_view>

#include "formats/picture_mean.h"
#include "tools/city/skip_counter.h"
#include "tools/citygml/picture_plan.h"

namespace nightcity::citygml {

/// The pictures beside one document. Safe to use from several threads.
class PictureColours {
 public:
  /// Pictures lie beside `document`, whose text is in Latin-1 or UTF-8; others are not read.
  PictureColours(const city::Document& document, bool latin1);

  /// Calls `take(id, colour)` for each target of the texture: the mean of the picture's part that
  /// its texture coordinates span, as sRGB from 0 to 1 in 32 steps a channel, since each colour
  /// becomes a material. Pictures that are absent, elsewhere, none or beyond the budget of the
  /// document's pictures are counted in `skipped`.
  void read(const pugi::xml_node& texture, city::SkipCounter& skipped,
            const std::function<void(std::string_view, const glm::vec3&)>& take);

  std::size_t pictures() const { return pictures_; }  // unpacked; again, where not kept meanwhile
  std::int64_t pixels() const { return pixels_; }
  std::size_t surfaces() const { return surfaces_; }

 private:
  std::shared_ptr<const Picture> find_picture(std::string_view uri, const char*& why);

  std::filesystem::path folder_;
  PicturePlan plan_;
  std::mutex mutex_;
  RecentPictures<std::shared_ptr<const Picture>> recent_;
  std::atomic<std::size_t> pictures_{0}, surfaces_{0};
  std::atomic<std::int64_t> pixels_{0};
};

}  // namespace nightcity::citygml
