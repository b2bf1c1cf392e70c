// Bounds what the pictures on the surfaces of one scene may cost.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tools/bake/city/surface_pictures.h"

namespace nightcity::bake {

/// Objects take from it in the order of the files, each for all of its pictures. The first that
/// does not fit ends it: that object and all that follow have none. So the result depends neither
/// on threads nor on parts, and whoever prepares later objects need not make their pictures.
class PictureBudget {
 public:
  explicit PictureBudget(std::uint64_t texels) : left_(texels) {}

  /// Returns whether an object may have its pictures, and takes their texels. One thread at a time.
  /// `surfaces`: how many of its polygons have a picture, also where none was made because the
  /// budget had ended.
  bool take(std::span<const PicturePiece> pieces, std::size_t surfaces) {
    std::uint64_t texels = 0;
    for (const PicturePiece& piece : pieces) texels += std::uint64_t{piece.width} * piece.height;
    if (texels > left_) has_ended_ = true;
    if (has_ended_) {
      surfaces_left_out_ += surfaces;
      return false;
    }
    left_ -= texels;
    return true;
  }

  /// Many threads may ask.
  bool has_ended() const { return has_ended_; }
  std::size_t surfaces_left_out() const { return surfaces_left_out_; }

 private:
  std::uint64_t left_;
  std::size_t surfaces_left_out_ = 0;
  std::atomic<bool> has_ended_ = false;
};

}  // namespace nightcity::bake
