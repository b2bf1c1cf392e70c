// Decides before a document is read which of its pictures are unpacked, so that the result depends
// neither on the number of threads that read it nor on their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_map>

#include "tools/city/byte_source.h"
#include "tools/city/picture_shelf.h"

namespace nightcity::citygml {

using city::find_picture_file;
using city::RecentPictures;

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
