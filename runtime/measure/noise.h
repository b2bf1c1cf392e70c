// The noise of pictures, from independent ones of the same view.
#pragma once

#include <span>

#include "runtime/measure/image.h"

namespace nightcity::measure {

/// Returns the relative RMSE of one of the pictures against their expected picture: the root of the
/// mean, over pixels and channels, of variance / (mean^2 + eps), with eps as in
/// Comparison::relative_mse. Bias is not seen. `pictures` are independent (other seeds). 0 where
/// all are black. Throws Error where there are fewer than two, or sizes differ.
double find_relative_noise(std::span<const Image> pictures);

/// Replaces `picture` by the mean of it and `other`, which has the same size and layers and as many
/// frames: colours and the light of each kind of source; layers of surfaces stay as they are.
void average_light(Image& picture, const Image& other);

}  // namespace nightcity::measure
