// Encodings of a CSV that nothing in it names.
#pragma once

#include <string>
#include <string_view>

#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

/// Returns the encoding, as iconv names it, in which a CSV's headings name places ("経度", "Широта")
/// where its bytes are no UTF-8, and they do not as Windows-1252: Japanese, Chinese, Korean,
/// Russian, Greek, Polish and Czech tables of older programs, and German ones of DOS and the Mac.
/// "" for all others.
std::string find_csv_encoding(std::string_view start, const InventoryFile& inventory);

/// Returns a text in UTF-8; what the encoding does not have becomes U+FFFD. `file` is for messages.
std::string decode_csv(std::string_view text, const std::string& encoding, const std::string& file);

}  // namespace nightcity::inventory
