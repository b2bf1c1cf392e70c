// ImageInfo as OpenEXR attributes under "nightcity.": shared by writer and reader.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include "runtime/measure/image.h"

namespace nightcity::measure {

void put_image_info(Imf::Header& header, const ImageInfo& info);

/// Fields that are missing, of another type or no number keep their defaults: the picture is usable
/// without.
ImageInfo get_image_info(const Imf::Header& header);

}  // namespace nightcity::measure
