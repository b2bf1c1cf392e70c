#include "tools/inventory/layer_columns.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/city/text_encoding.h"

namespace nightcity::inventory {
namespace {

int find_column(const OGRLayer& layer, const std::string& name, const InventoryFile& inventory) {
  const OGRFeatureDefn& columns = *const_cast<OGRLayer&>(layer).GetLayerDefn();
  for (int i = 0; i < columns.GetFieldCount(); ++i)
    if (name == city::decode_text(columns.GetFieldDefn(i)->GetNameRef())) return i;
  if (const int any_case = columns.GetFieldIndex(name.c_str()); any_case >= 0) return any_case;
  throw Error(inventory.file.string(),
              "has no column \"" + name + "\": it has " + list_columns(layer));
}

// Returns a number without the zeros that a Shapefile's fixed width adds.
std::string to_text(OGRFeature& row, int field) {
  const OGRFieldDefn& definition = *row.GetFieldDefnRef(field);
  if (definition.GetSubType() == OFSTBoolean) return row.GetFieldAsInteger(field) ? "yes" : "no";
  if (definition.GetType() != OFTReal) return row.GetFieldAsString(field);
  char text[40];
  std::snprintf(text, sizeof text, "%.15g", row.GetFieldAsDouble(field));
  return text;
}

bool is_number(std::string_view text) {
  return text.find_first_not_of("0123456789.,+- ") == std::string_view::npos;
}

// Returns where the last word of "MountHeightFeet" begins; 0 where there is one word alone.
std::size_t find_last_word(std::string_view heading) {
  const auto is_in = [&](std::size_t at, char low, char high) {
    return heading[at] >= low && heading[at] <= high;
  };
  for (std::size_t at = heading.size(); at-- > 1;)
    if (is_in(at, 'A', 'Z') && is_in(at - 1, 'a', 'z')) return at;
  return 0;
}

// Returns the unit that the heading of a column ends in where it is not the one that lamps are read
// in: "Mounting height (ft)", "HEIGHT_FT", "HeightFeet", "Flux [klm]". A table says it there once
// for all rows.
std::string_view find_unit(std::string_view property, std::string_view heading) {
  struct Unit {
    std::string_view property, word, unit;
  };
  constexpr std::array<Unit, 10> units{{{"height", "ft", "ft"},
                                        {"height", "feet", "ft"},
                                        {"height", "foot", "ft"},
                                        {"height", "inches", "in"},
                                        {"height", "dm", "dm"},
                                        {"height", "cm", "cm"},
                                        {"height", "mm", "mm"},
                                        {"height", "in", "in"},
                                        {"lumens", "klm", "klm"},
                                        {"watts", "kw", "kW"}}};
  const std::string lower = to_lower(city::trim(heading));
  std::string_view name = lower;
  const bool in_brackets = name.ends_with(')') || name.ends_with(']');
  if (in_brackets) name.remove_suffix(1);
  const std::size_t before = name.find_last_of(in_brackets ? "([" : "_ .-");
  const std::size_t begin =
      before == std::string_view::npos ? find_last_word(city::trim(heading)) : before + 1;
  const std::string_view word = city::trim(name.substr(begin));
  for (const Unit& unit : units)
    if (unit.property == property && unit.word == word) return unit.unit;
  return {};
}

// "123,45" in one cell of a table is a number, where a tag of the map would list two bearings.
void use_decimal_point(std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || text.size() - comma > 3 || comma == 0) return;
  if (!is_number(text.substr(comma + 1)) || !is_number(text.substr(0, comma))) return;
  text[comma] = '.';
}

}  // namespace

std::string list_columns(const OGRLayer& layer) {
  const OGRFeatureDefn& columns = *const_cast<OGRLayer&>(layer).GetLayerDefn();
  constexpr int most = 50;  // more are no help, and tables may have as many as GDAL reads, 2,000
  const int count = columns.GetFieldCount();
  std::string names;
  for (int i = 0; i < std::min(count, most); ++i)
    names += std::string(i > 0 ? ", \"" : "\"") + columns.GetFieldDefn(i)->GetNameRef() + "\"";
  if (count > most) names += " and " + std::to_string(count - most) + " more";
  return names.empty() ? "none" : city::decode_text(std::move(names));
}

LayerColumns::LayerColumns(const OGRLayer& layer, const InventoryFile& inventory)
    : used_(properties.size()) {
  for (const auto& [name, column] : inventory.columns) {
    const Property* property = find_property(name);
    if (!property) throw Error(inventory.file.string(), "no lamp has the property " + name);
    const auto values = inventory.values.find(name);
    const bool is_said = inventory.feet && property->name == "height";
    columns_.push_back({find_column(layer, column, inventory), property,
                        static_cast<std::size_t>(property - properties.data()),
                        values == inventory.values.end() ? nullptr : &values->second,
                        is_said ? "ft" : find_unit(property->name, column)});
  }
  if (!inventory.id.empty()) id_ = find_column(layer, inventory.id, inventory);
}

osm::OsmTags LayerColumns::read(const OGRFeature& row) const {
  osm::OsmTags tags;
  for (const Column& column : columns_) {
    if (!row.IsFieldSetAndNotNull(column.field)) continue;
    const std::string raw = to_text(const_cast<OGRFeature&>(row), column.field);
    const std::string decoded = city::decode_text(raw);
    takes_windows_1252_ = takes_windows_1252_ || decoded != raw;
    std::string text(city::trim(decoded));
    if (column.values)
      if (const auto word = column.values->find(text); word != column.values->end())
        text = word->second;
    if (text.empty()) continue;
    ++used_[column.number];
    if (!column.unit.empty() && is_number(text)) text += " " + std::string(column.unit);
    if (column.property->name == "direction") use_decimal_point(text);
    tags.emplace(column.property->tag, std::move(text));
  }
  return tags;
}

std::string LayerColumns::read_id(const OGRFeature& row) const {
  if (id_ >= 0 && row.IsFieldSetAndNotNull(id_))
    return city::decode_text(to_text(const_cast<OGRFeature&>(row), id_));
  return "row " + std::to_string(row.GetFID());
}

}  // namespace nightcity::inventory
