// Reads an inventory of street lamps from a vector file.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/inventory/inventory.h"
#include "tools/osm/osm_data.h"

namespace nightcity::inventory {

/// Thrown where all rows with a place lie outside of what their CRS can mean.
struct OutsideCrs : Error {
  using Error::Error;
};

struct InventoryReport {
  std::string file, format;  // its name; "GeoJSON"
  std::size_t rows = 0;
  std::size_t lamps = 0;                       // posts that the rows make
  std::map<std::string, std::size_t> skipped;  // rows, by reason
  std::size_t joined = 0;                      // rows that join a post at the same place
  std::size_t replaced = 0;                    // lamps of the map in whose place these stand
  std::map<std::string, std::size_t> columns;  // property, rows that have it
  std::size_t titles = 0;                      // lines of a CSV above its headings
  std::string encoding;  // of its texts, which nothing in it names; "": UTF-8, or it names its own
  std::string incomplete;                      // what the server left out (server_limit.h)
  std::string doubt;                           // what may place its lamps wrongly
};

struct Inventory {
  std::vector<osm::OsmLampNode> lamps;  // with is_inventory, in the order of the rows
  InventoryReport report;
};

/// Each row with a point is a post; those at the same place are luminaires of one post, whose
/// lumens and watts are the mean of theirs. Throws Error: as open_vector_file, no CRS, a column is
/// absent, more rows than max_lamps, no row with a place; OutsideCrs.
Inventory read_inventory(const InventoryFile& file);

}  // namespace nightcity::inventory
