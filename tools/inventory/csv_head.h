// Finds the headings of a CSV, above which exports put titles.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

struct CsvHead {
  std::size_t begin = 0;  // offset of the line with the headings
  std::size_t above = 0;  // lines before it that hold something
  bool is_found = false;  // headings of places are there; else the first line is taken
};

/// Returns the first of a CSV's lines whose cells name places: by common names, or as x and y of
/// the inventory. It is the first line of all; or one with numbers below the names; or one below
/// lines that have another number of cells or few that hold anything, as titles have ("Street
/// lights;;;"). Looks at the first lines alone.
CsvHead find_csv_head(std::string_view text, const InventoryFile& inventory);

}  // namespace nightcity::inventory
