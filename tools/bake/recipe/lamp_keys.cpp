#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "formats/program/nearest_word.h"
#include "tools/bake/recipe/tables.h"
#include "tools/lights/lamp_defaults.h"
#include "tools/lights/lamp_tags.h"
#include "tools/lights/lighting_class.h"
#include "tools/roads/road_class.h"

namespace nightcity::recipe {
namespace {

void check_road(const Value& value, const std::string& highway) {
  const lights::RoadLighting* road = lights::find_road_lighting(highway);
  if (road && road->highway == highway) return;
  std::vector<std::string> known;
  for (const roads::RoadClass& road_class : roads::road_classes())
    known.emplace_back(lights::find_road_lighting(road_class).highway);
  const std::string nearest = program::find_nearest_word(highway, known);
  value.refuse("names no class of road that may have lamps: \"" + highway + "\"" +
               (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

std::map<std::string, std::string> to_lighting_classes(const Value& value) {
  std::map<std::string, std::string> result;
  for (const auto& [highway, row] : value.rows("a table like {residential = \"P4\"}")) {
    check_road(row, highway);
    if (!lights::lighting_class(row.text()))
      row.refuse("is no lighting class of EN 13201-2: P1 to P6, C0 to C5, M1 to M6");
    result[highway] = row.text();
  }
  return result;
}

std::map<std::string, lights::NightSpan> to_night_spans(const Value& value) {
  std::map<std::string, lights::NightSpan> result;
  for (const auto& [highway, row] : value.rows("a table like {residential = \"23:00-05:00\"}")) {
    check_road(row, highway);
    const auto span = lights::parse_night_span(row.text());
    if (!span) row.refuse("is no span of the night like \"23:00-05:00\", between 17:00 and 07:00");
    result[highway] = *span;
  }
  return result;
}

// A row that says the same as one before it changes nothing: the first row counts that fits a lamp,
// or knows it.
template <class Row>
void leave_out_repeats(const Value& value, std::vector<Row>& rows) {
  std::set<Row> known;
  const std::size_t named = rows.size();
  std::erase_if(rows, [&](const Row& row) { return !known.insert(row).second; });
  if (const std::size_t repeats = named - rows.size(); repeats > 0)
    value.note("holds rows again that it has held, " + std::to_string(repeats) +
               (repeats == 1 ? " time" : " times") + ": each counts once");
}

std::vector<bake::LuminaireFile> to_luminaires(const Value& value,
                                               const std::filesystem::path& folder) {
  const std::string what =
      "a list of tables like {file = \"street.ldt\", roads = [\"residential\"]}";
  std::vector<bake::LuminaireFile> result;
  for (const Value& element : value.elements(0, what)) {
    const toml::table* settings = element.node.as_table();
    if (!settings) element.refuse("is not " + what);
    bake::LuminaireFile& luminaire = result.emplace_back();
    read_keys(value.file, value.name + ".", *settings,
              make_luminaire_table(luminaire, folder).keys);
    if (luminaire.file.empty()) element.refuse("names no file");
  }
  leave_out_repeats(value, result);
  return result;
}

// Returns the name of a property, or refuses one that lamps do not have.
std::string to_property(const Value& value, const std::string& name) {
  if (inventory::find_property(name)) return name;
  std::string names;
  for (const inventory::Property& property : inventory::properties)
    names += (names.empty() ? "" : ", ") + std::string(property.name);
  value.refuse("is no property of a lamp: those are " + names);
}

std::string list_properties() {
  std::string text;
  for (const inventory::Property& property : inventory::properties)
    text += (text.empty() ? "`" : ", `") + std::string(property.name) + "` (" +
            std::string(property.help) + ")";
  return text;
}

std::vector<inventory::InventoryFile> to_inventories(const Value& value,
                                                     const std::filesystem::path& folder) {
  const std::string what = "a list of tables like {file = \"lamps.geojson\"}";
  std::vector<inventory::InventoryFile> result;
  for (const Value& element : value.elements(0, what)) {
    const toml::table* settings = element.node.as_table();
    if (!settings) element.refuse("is not " + what);
    inventory::InventoryFile& file = result.emplace_back();
    read_keys(value.file, value.name + ".", *settings, make_inventory_table(file, folder).keys);
    if (file.file.empty()) element.refuse("names no file");
  }
  leave_out_repeats(value, result);
  return result;
}

Key layout_key(layout::LayoutOptions::Mode& mode) {
  using Mode = layout::LayoutOptions::Mode;
  return choice_key<Mode>(
      "layout", mode, {{"auto", Mode::automatic}, {"never", Mode::never}, {"always", Mode::always}},
      "Whether to lay out lamps along lit streets. `auto`: where no mapped lamp stands within 1.5 "
      "spacings on the same street. `always`: everywhere, and mapped lamps are not used.");
}

Key night_spans_key(std::string name, std::map<std::string, lights::NightSpan>& spans,
                    std::string example, std::string help) {
  return {std::move(name),
          "table: highway = \"HH:MM-HH:MM\"",
          "",
          "local time",
          "within 17:00 to 07:00",
          std::move(example),
          std::move(help),
          [&spans](const Value& value) { spans = to_night_spans(value); }};
}

}  // namespace

Table make_lamp_table(bake::LampStageOptions& lamps, const std::filesystem::path& folder) {
  return {
      "lamps",
      "Street lamps. Keys of the inner tables are values of OSM's `highway`: `motorway`, `trunk`, "
      "`primary`, `secondary`, `tertiary`, `unclassified`, `residential`, `living_street`, "
      "`service`, `pedestrian`, `footway`, `path`, `steps`, `cycleway` and others that may have "
      "lamps.",
      {layout_key(lamps.layout.mode),
       {"class", "table: highway = lighting class", "", "", "M1 to M6, C0 to C5, P1 to P6",
        R"({residential = "P4"})",
        "Lighting class of EN 13201-2 for a class of road, in place of the built-in one. The light "
        "of lamps laid out is chosen to meet it.",
        [&lamps](const Value& value) { lamps.layout.class_of = to_lighting_classes(value); }},
       night_spans_key("off", lamps.hours.off, R"({service = "00:30-04:30"})",
                       "Every lamp along these classes of road is dark in the span, unless its own "
                       "tags say otherwise."),
       night_spans_key("half_night", lamps.hours.half_night, R"({residential = "23:00-05:00"})",
                       "Every second lamp along each of these roads is dark in the span."),
       number_key("merge_m", lamps.merge_m, {0, 1000}, "m",
                  "Merges lamps, for cities with more of them than a scene can hold: each takes in "
                  "the weaker ones of its distribution, colour and hours that stand within so much "
                  "of it and aim within 60 degrees of its aim. It stays where it is, and has the "
                  "flux of all of them; their posts are gone. 0 merges none."),
       {"luminaires", "list of tables", "", "", "",
        R"([{file = "street.ldt", roads = ["residential"]}])",
        "Measured luminaires to use in place of the built-in distributions; the first row that "
        "fits a lamp counts.",
        [&lamps, folder](const Value& value) { lamps.luminaires = to_luminaires(value, folder); }},
       {"inventories", "list of tables", "", "", "", R"([{file = "lamps.geojson"}])",
        "Inventories of lamps as towns publish them. Their lamps stand in place of the map's where "
        "both know one.",
        [&lamps, folder](const Value& value) {
          lamps.inventories = to_inventories(value, folder);
        }}}};
}

Table make_inventory_table(inventory::InventoryFile& row, const std::filesystem::path& folder) {
  const std::string columns_example = R"({height = "MOUNT_HT", watts = "WATTS", type = "LAMP"})";
  return {
      "lamps.inventories",
      "One inventory: a row of `[lamps] inventories`. Each row of its table is a lamp; rows at the "
      "same place are luminaires of one post. What a row does not say comes from the road beside "
      "the lamp, as for lamps of the map.",
      {{"file", "path", "", "", "", "\"lamps.geojson\"",
        "GeoJSON, CSV, GeoPackage, Shapefile, FlatGeobuf, or rows in JSON as servers answer; "
        "plain, or packed (docs/recipe.md, Packed files): the only table in an archive. A CSV may "
        "end in .txt. The headings of a CSV are the first that name places, also below titles. "
        "Required.",
        [&row, folder](const Value& value) { row.file = value.path(folder); }},
       text_key("layer", row.layer, "\"lamps\"",
                "The layer, where several in the file may hold points."),
       text_key("crs", row.crs, "\"EPSG:25833\"",
                "Coordinate reference system, in place of the one that the file names. A CSV names "
                "none, so it is required there: `\"EPSG:4326\"` for longitude and latitude."),
       text_key("x", row.x, "\"LON\"",
                "The column of a CSV with longitude or easting. Without it: a common name (lon, "
                "longitude, x, easting, ..., also as in `GPS_LON` or `coord. x`), or a column of "
                "points as text (WKT)."),
       text_key("y", row.y, "\"LAT\"",
                "The column of a CSV with latitude or northing. Without it: a common name."),
       text_key("id", row.id, "\"POLEID\"",
                "The column that tells lamps apart, so that one keeps its identity when rows are "
                "added. Without it: the number of the row."),
       {"columns", "table: property = column", "", "", "", columns_example,
        "The columns that say what a lamp is like. Properties: " + list_properties() + ".",
        [&row](const Value& value) {
          for (const auto& [name, column] : value.rows("a table like {watts = \"WATTS\"}"))
            row.columns[to_property(column, name)] = column.text();
        }},
       {"values", "table: property = table", "", "", "",
        R"({type = {FL = "fluorescent"}, state = {Removed = "no"}})",
        "Texts of a column and the words to read in their place.",
        [&row](const Value& value) {
          for (const auto& [name, words] : value.rows("a table like {type = {FL = \"led\"}}"))
            for (const auto& [text, word] : words.rows("a table like {FL = \"fluorescent\"}"))
              row.values[to_property(words, name)][text] = word.text();
        }},
       choice_key<bool>(
           "height_unit", row.feet, {{"m", false}, {"ft", true}},
           "The unit of heights of which neither they nor their column's name (MOUNT_HT_FT) "
           "say one."),
       number_key("within_m", row.within_m, {0, 100}, "m",
                  "A lamp of the map, or of an inventory that is named later, as near as this to a "
                  "lamp of the inventory is the same lamp and is not used. The default is how well "
                  "a phone knows its place under open sky (4.9 m, gps.gov); 0 keeps all."),
       integer_key("max_lamps", row.max_lamps, 1, 100'000'000,
                   "A limit: the bake ends at an inventory of more rows or lamps."),
       text_key("licence", row.licence, "\"City of Example, CC0\"",
                "The attribution that both output files carry.")}};
}

Table make_luminaire_table(bake::LuminaireFile& row, const std::filesystem::path& folder) {
  return {"lamps.luminaires",
          "One measured luminaire: a row of `[lamps] luminaires`.",
          {{"file", "path", "", "", "", "\"street.ldt\"",
            "Photometric file: IES LM-63, EULUMDAT, TM-33 (XML) or GLDF; plain, or packed "
            "(docs/recipe.md, Packed files): the only one in an archive. Required.",
            [&row, folder](const Value& value) { row.file = value.path(folder); }},
           {"roads", "list of strings", "", "", "values of OSM's `highway`", R"(["residential"])",
            "Only for lamps beside these classes of road. Without it: beside every road.",
            [&row](const Value& value) {
              for (const std::string& road : value.texts()) {
                check_road(value, road);
                row.highways.push_back(road);
              }
            }},
           {"types", "list of strings", "", "", "values of OSM's `lamp_type`", R"(["led"])",
            "Only for lamps of these types. Without it: for every type.",
            [&row](const Value& value) {
              for (const std::string& type : value.texts()) {
                const auto known = lights::parse_lamp_type(type);
                if (!known) value.refuse("holds no type of lamp: \"" + type + "\"");
                row.types.push_back(*known);
              }
            }},
           texts_key("models", row.models, R"(["XYZ-40"])",
                     "Only for lamps whose inventory names one of these as their luminaire "
                     "(`columns = {model = ...}`). Without it: for every lamp."),
           flag_key("flux", row.take_flux,
                    "Takes the luminous flux from the file too, for lamps whose tags name none. "
                    "`false` takes only the distribution.")}};
}

}  // namespace nightcity::recipe
