// Refuses OpenEXR files whose headers claim more than the files hold.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstddef>
#include <span>

namespace nightcity::measure {

/// Throws Error, without a file name, where a header claims attributes, chunks or sides that the
/// file cannot hold, or more channels than any renderer writes: OpenEXR makes room for all of it
/// before it reads on. `stream` reads the same bytes, and is at their beginning afterwards.
void refuse_false_claims(std::span<const std::byte> bytes, Imf::IStream& stream);

}  // namespace nightcity::measure
