// The columns of a layer that the recipe names, and their values as tags of lamps.
#pragma once

#include <ogrsf_frmts.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/inventory/inventory.h"
#include "tools/osm/osm_data.h"

namespace nightcity::inventory {

/// Returns the names of the layer's first columns, each in quotation marks, and how many more it
/// has.
std::string list_columns(const OGRLayer& layer);

class LayerColumns {
 public:
  /// Finds the columns, whatever case their names are written in: Shapefile and databases change
  /// it. Throws Error where one is absent, with those there are.
  LayerColumns(const OGRLayer& layer, const InventoryFile& inventory);

  /// Returns the tags that the row's values stand for; empty values give none.
  osm::OsmTags read(const OGRFeature& row) const;
  /// Returns the text that tells the row apart: of the id column, else the row's number.
  std::string read_id(const OGRFeature& row) const;
  /// Returns how many rows gave each property a value, in the order of `properties`.
  const std::vector<std::size_t>& used() const { return used_; }
  /// Returns whether some of these values were no UTF-8 and were taken as Windows-1252.
  bool takes_windows_1252() const { return takes_windows_1252_; }

 private:
  struct Column {
    int field;
    const Property* property;
    std::size_t number;                                // of the property
    const std::map<std::string, std::string>* values;  // null: none to replace
    std::string_view unit;                             // of numbers; empty: the property's own
  };
  std::vector<Column> columns_;
  int id_ = -1;
  mutable std::vector<std::size_t> used_;
  mutable bool takes_windows_1252_ = false;
};

}  // namespace nightcity::inventory
