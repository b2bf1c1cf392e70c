// Recognises archives and compressed files where a reader does not unpack them, for messages: given
// as scenes, or packed once more.
#pragma once

#include <string_view>

namespace nightcity {

/// Returns what a file with these first bytes (at least 263, so that tar is seen) is packed by, and
/// the remedy, as the end of a message: "is packed by xz: unpack it first (unxz)". Empty where it
/// is not known to be packed. gzip, bzip2 and zip are not among these: some readers unpack them.
std::string_view describe_packed(std::string_view start);

}  // namespace nightcity
