// Decides before a document is read which of its pictures are unpacked, so that the result depends
// neither on the number of threads that read it nor on their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "formats/picture_mean.h"
#include "tools/city/byte_source.h"

namespace nightcity::citygml {

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

/// The pictures that a document names, and whether PictureBudget has room for each. A picture that
/// comes again later than RecentPictures remembers is counted again.
class PicturePlan {
 public:
  /// Looks through all of `document` for names. Throws Error where it cannot be read.
  PicturePlan(const city::Document& document, bool latin1);

  enum class Fate : std::uint8_t { unpacked, beyond_budget, unseen };
  /// Returns what becomes of a file: `unseen` where no name was found that leads to it.
  Fate find_fate(const std::filesystem::path& file) const {
    const auto at = fates_.find(file.native());
    return at == fates_.end() ? Fate::unseen : at->second;
  }

 private:
  std::unordered_map<std::string, Fate> fates_;
};

}  // namespace nightcity::citygml
