#include "tools/bake/recipe/tables.h"

#include <limits>

#include "tools/lights/night_schedule.h"

namespace nightcity::recipe {
namespace {

namespace fs = std::filesystem;

// Turns "22:00" into minutes after 17:00. The night ends at 07:00.
int to_minute_of_night(const Value& value) {
  const std::string text = value.text();
  const auto is_digit = [&text](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  if (text.size() != 5 || text[2] != ':' || !is_digit(0) || !is_digit(1) || !is_digit(3) ||
      !is_digit(4))
    value.refuse("is not a time like \"22:00\"");
  const int hour = (text[0] - '0') * 10 + text[1] - '0';
  const int minute = (text[3] - '0') * 10 + text[4] - '0';
  if (hour > 23 || minute > 59) value.refuse("is not a time like \"22:00\"");
  const int minute_of_night = lights::minute_of(hour, minute);
  if (minute_of_night >= lights::night_minutes) value.refuse("is not between 17:00 and 07:00");
  return minute_of_night;
}

Table make_osm_table(bake::Recipe::Osm& osm, const fs::path& folder) {
  return {
      "osm",
      "The map: street lamps, streets, and outlines that say what a building is used for.",
      {paths_key("files", osm.files, folder, {}, R"(["streets.osm.pbf"])",
                 "OpenStreetMap extracts: .osm, .osm.pbf, .osm.gz, .osm.bz2 or JSON as Overpass "
                 "answers, or packed otherwise (docs/recipe.md, Packed files): the only map in an "
                 "archive. Paths are relative to the recipe. Several extracts are merged; an "
                 "object that is in more than one is taken in its newest version. Nodes, ways and "
                 "relations may lie in files of their own."),
       flag_key("buildings", osm.buildings,
                "Without `[city] files`, the map's buildings are the city model: `building`, "
                "`building:part`, `height`, `est_height`, `min_height`, `building:levels`, "
                "`building:min_level`, `roof:shape` (flat, gabled, hipped, pyramidal, "
                "skillion, gambrel, mansard, half-hipped, "
                "saltbox, round, dome, onion, cone, sawtooth, butterfly and rarer ones), "
                "`roof:height`, `roof:angle`, `roof:levels`, `roof:direction`, "
                "`roof:orientation`. They stand on `[terrain] dem`, each on the lowest ground "
                "below it, or on a plane at height 0. Levels are 3 m; buildings without any "
                "height get the levels of their kind, and are counted as assumed. "
                "Chimneys, silos, tanks, gasometers, water towers and other towers "
                "(`man_made`) that no `building` stands for are drawn too, without windows; of "
                "points those with `height` and `diameter` or `width`, round."),
       flag_key("colours", osm.colours,
                "Walls and roofs of the map's buildings have the colours that `building:colour`, "
                "`roof:colour`, `building:material` and `roof:material` say. White reflects "
                "0.75, as paint does, and other colours less."),
       text_key("licence", osm.licence, "\"OpenStreetMap contributors, ODbL 1.0\"",
                "The attribution that both output files carry."),
       integer_key("max_way_nodes", osm.max_way_nodes, 2, 100'000'000,
                   "A limit: streets, buildings and lamps of more nodes are left out, with a "
                   "note; of a multipolygon, the nodes of all its ways count. OpenStreetMap "
                   "itself allows 2000 for a way.")}};
}

Table make_origin_table(bake::Recipe::Origin& origin) {
  const Limits limits{-1e8, 1e8};
  return {"origin",
          "The origin of model space, in the city's projected coordinate reference system. Name it "
          "to bake neighbouring areas into one frame. A coordinate left out is chosen from the "
          "data. Keep the city within 20 km of the origin: coordinates in model space are 32-bit "
          "floats. One over 100 km away is moved in whole steps of 50 km, which is said.",
          {number_key("easting", origin.easting, limits, "m", "391000",
                      "Easting of the origin. Without it: the median of the city's tiles."),
           number_key("northing", origin.northing, limits, "m", "5819000",
                      "Northing of the origin. Without it: the median of the city's tiles."),
           number_key("height", origin.height, limits, "m", "30",
                      "Height of the origin. Without it: the median height of the points at the "
                      "beginning of the first file.")}};
}

Table make_window_table(bake::WindowStageOptions& windows) {
  return {"windows",
          "Lit windows.",
          {flag_key("lit", windows.lit, "Whether the city gets lit windows at all."),
           integer_key("seed", windows.seed, 0, std::numeric_limits<int>::max(),
                       "Seed of the random draws that decide which windows are lit and when. "
                       "Another seed gives other evenings of the same statistics."),
           choice_key<lights::WindowGrouping>(
               "group", windows.group,
               {{"none", lights::WindowGrouping::none},
                {"storey", lights::WindowGrouping::storey},
                {"facade", lights::WindowGrouping::facade}},
               "Takes lit windows together, for cities with more of them than a scene can hold: "
               "those of a storey or of a whole wall, within 20 m, become one emitter with the sum "
               "of their light, spread evenly, and the hours of one of them, drawn by its share of "
               "the light. What is lost: `nightbake price` (docs/price.md)."),
           flag_key("panes", windows.panes,
                    "Whether cameras see frames, curtains and rooms in lit windows, and what the "
                    "glass mirrors. Each window stays one light, of which it has the luminance in "
                    "the mean. false, or with windows taken together: even rectangles."),
           integer_key("max_per_building", windows.max_per_building, 1, 100'000'000,
                       "A limit: a building that would get more windows gets none, and is counted "
                       "in the report.")}};
}

Table make_night_table(bake::Recipe::Night& night) {
  return {"night",
          "The one moment that `city.glb` shows to programs that cannot read schedules. "
          "`city.lights` always holds the whole night.",
          {{"time", "string", "\"22:00\"", "local time", "\"17:00\" to \"06:59\"", "\"22:00\"",
            "Decides which windows are bright and where the vehicles stand in `city.glb`.",
            [&night](const Value& value) { night.minute = to_minute_of_night(value); }}}};
}

Table make_output_table(bake::Recipe::Output& output) {
  return {"output",
          "How `city.glb` is written.",
          {flag_key("draco", output.draco,
                    "Compresses meshes with Draco (`KHR_draco_mesh_compression`)."),
           number_key("draco_tolerance_m", output.draco_tolerance_m, {1e-5, 10}, "m",
                      "With `draco`: the largest distance that a vertex may move. Windows stand "
                      "0.02 m before their walls: with more than that, walls hide some."),
           flag_key("hierarchies", output.hierarchies,
                    "Stores which triangles lie together in the hierarchies that rays traverse "
                    "(`NIGHTCITY_hierarchy`), so that nightview need not build them: it opens the "
                    "city in less time. Other programs do not read them."),
           integer_key("punctual", output.punctual, 0, 1'000'000,
                       "Copies this many of the lights that are brightest at `[night] time` into "
                       "`city.glb` as `KHR_lights_punctual`, for programs that do not read "
                       "`city.lights`.")}};
}

Table make_light_table(bake::Recipe::Lights& lights, const fs::path& folder) {
  return {
      "lights",
      "All lamps and windows, whatever they come from.",
      {paths_key("edits", lights.edits, folder, {.kept = inputs::Mention::last},
                 R"(["city.edits.json"])",
                 "Files of single lights that were switched off, dimmed or aimed by hand, as the "
                 "window of nightview writes them (formats/SPEC.md, section 5). Lights keep "
                 "their identity from bake to bake, so a file stays good. Of several edits of "
                 "a light, that of the last file holds. Edits of lights that are not there are "
                 "counted. Paths are relative to the recipe.")}};
}

}  // namespace

std::vector<Table> make_tables(bake::Recipe& recipe, const fs::path& folder) {
  return {make_city_table(recipe.city, folder),       make_osm_table(recipe.osm, folder),
          make_terrain_table(recipe.terrain, folder), make_ground_table(recipe.ground),
          make_lamp_table(recipe.lamps, folder),      make_map_light_table(recipe.map_lights),
          make_window_table(recipe.windows),          make_light_table(recipe.lights, folder),
          make_traffic_table(recipe.traffic),         make_night_table(recipe.night),
          make_origin_table(recipe.origin),           make_output_table(recipe.output)};
}

}  // namespace nightcity::recipe
