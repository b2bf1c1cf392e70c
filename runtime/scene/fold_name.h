// Names as people type them.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::scene {

/// Returns a name (UTF-8) in small letters without diacritics, with one blank for blanks, hyphens
/// and other marks between words: "Karl-Marx-Straße" becomes "karl marx strasse". Latin letters
/// lose their diacritics, Greek and Cyrillic ones become small, others stay.
std::string fold_name(std::string_view name);

}  // namespace nightcity::scene
