// The pictures that a document names as textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/picture_mean.h"

namespace nightcity::city {

/// Remembers what was made of the latest pictures, by their files: as many as have, together, the
/// pixels of one largest picture. A picture of many buildings comes up again soon.
template <class T>
class RecentPictures {
 public:
  const T* find(const std::filesystem::path& file) const {
    const auto at = kept_.find(file.native());
    return at == kept_.end() ? nullptr : &at->second.second;
  }

  void add(const std::filesystem::path& file, std::int64_t pixels, T picture) {
    if (!kept_.try_emplace(file.native(), pixels, std::move(picture)).second) return;
    order_.push_back(file.native());
    for (pixels_ += pixels; pixels_ > max_picture_pixels; order_.pop_front()) {
      const auto oldest = kept_.find(order_.front());
      pixels_ -= oldest->second.first;
      kept_.erase(oldest);
    }
  }

 private:
  std::unordered_map<std::string, std::pair<std::int64_t, T>> kept_;
  std::deque<std::string> order_;
  std::int64_t pixels_ = 0;
};

/// Returns the file that an imageURI names. Nothing where it would lie outside `folder`.
std::optional<std::filesystem::path> find_picture_file(const std::filesystem::path& folder,
                                                       std::string_view uri);

/// Returns the mean of the picture's part between two texture coordinates, as sRGB from 0 to 1 in 32
/// steps a channel, since each colour becomes a material.
glm::vec3 find_mean_step(const Picture& picture, const glm::dvec2& low, const glm::dvec2& high);

/// The pictures of a list, unpacked when they are asked for. Safe to use from several threads.
class PictureShelf {
 public:
  /// Pictures lie beside `document`. Those that PictureBudget has no room for, in the order of the
  /// list, are not unpacked: so the result does not depend on who asks first.
  PictureShelf(const std::filesystem::path& document, std::vector<std::string> names);

  std::size_t size() const { return entries_.size(); }
  /// Returns the picture of that number; null, and `why` in words, where it cannot be had.
  std::shared_ptr<const Picture> find(std::size_t number, const char*& why);

 private:
  struct Entry {
    std::filesystem::path file;
    const char* fault;  // null: it may be unpacked
  };
  std::vector<Entry> entries_;
  std::mutex mutex_;
  RecentPictures<std::shared_ptr<const Picture>> recent_;
};

}  // namespace nightcity::city
