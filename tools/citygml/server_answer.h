// Tells by the answer of a server (WFS) whether it is all that was asked for.
#pragma once

#include <string>
#include <string_view>

#include "tools/citygml/member_splitter.h"

namespace nightcity::citygml {

/// Returns why an answer of WFS 2.0 is a part of what there is, by its root's numberMatched,
/// numberReturned and next; "" where it says no such thing.
std::string find_what_is_missing(const DocumentHead& head);

/// Returns whether a member of such an answer says that the server broke it off.
bool is_server_error(std::string_view member);

}  // namespace nightcity::citygml
