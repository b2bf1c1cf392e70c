#include "tools/bake/recipe/tables.h"

#include <limits>

#include "tools/lights/night_schedule.h"
#include "tools/terrain/raster_names.h"

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
                 "answers, or the only map in a .zip. Paths are relative to the recipe. Several "
                 "extracts are merged; an object that is in more than one is taken in its newest "
                 "version."),
       flag_key("buildings", osm.buildings,
                "Without `[city] files`, the map's buildings are the city model: `building`, "
                "`building:part`, `height`, `est_height`, `min_height`, `building:levels`, "
                "`building:min_level`, `roof:shape` (flat, gabled, hipped, pyramidal, "
                "skillion, gambrel, mansard, half-hipped, "
                "saltbox, round, dome, onion, cone, sawtooth, butterfly and rarer ones), "
                "`roof:height`, `roof:angle`, `roof:levels`, `roof:direction`, "
                "`roof:orientation`. They stand on `[terrain] dem`, each on the lowest ground "
                "below it, or on a plane at height 0. Levels are 3 m; buildings without any "
                "height get the levels of their kind, and are counted as assumed."),
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

Table make_terrain_table(bake::GroundOptions& terrain, const fs::path& folder) {
  return {
      "terrain",
      "The ground of a city whose model has no relief.",
      {paths_key(
           "dem", terrain.elevation_models, folder, {.expand = terrain::list_raster_files},
           R"(["heights.tif", "tiles.zip"])",
           "Digital elevation models in a raster format that GDAL reads, except those "
           "that lead to other files or the network (VRT, WMS), and in GSI's of Japan "
           "(FG-GML-...-DEM...xml). A folder stands for the rasters "
           "in it and in the folders inside it, a .zip for those in it with their .tfw, .prj or "
           ".hdr (a text in it is one where nothing else is), and a .gz is unpacked. Rasters that "
           "come beside heights and say how good they are (`_HEM`, `_num`, ...) are passed over, "
           "with a note. Where several have a height the "
           "finest decides, of about equally fine ones the first. Their heights are moved to meet "
           "the buildings, those of each resolution by themselves. Where none has a height, the "
           "ground goes on between the edges of the data and the buildings' feet (`make_surface`), "
           "and a map's building stands on a height near it, within 5 km; the report says how "
           "much. Where the city model has a relief of its own, they are used beyond it alone."),
       text_key("dem_crs", terrain.elevation_crs, "\"EPSG:25832\"",
                "The CRS of elevation models that name none, as tables of `x y z` do, in "
                "themselves or in a `.prj` beside them. Without it, they have the city's."),
       integer_key("max_dem_block_mpx", terrain.max_dem_block_mpx, 1, 10'000,
                   "A limit: the bake ends at an elevation model whose blocks (tiles or rows, "
                   "which are unpacked as a whole) have more pixels, in millions. The size of "
                   "the model itself does not matter."),
       integer_key("max_dem_unpacked_mb", terrain.max_dem_unpacked_mb, 1, 100'000'000,
                   "A limit: the bake ends where the elevation models in archives and gzip "
                   "streams together unpack to more, in MB of the temporary folder. One entry "
                   "unpacks to 200 times its size or 1 GB at most."),
       flag_key(
           "make_surface", terrain.make_surface,
           "Where there is neither a relief nor an elevation model, makes a ground "
           "surface through the footprints of the buildings. Where one of these ends within the "
           "city, or has gaps, the ground goes on in the same way."),
       number_key("max_error_m", terrain.max_error_m, {0, 100}, "m",
                  "Thins the ground, whatever it is made of: vertices are left out where the "
                  "ground stays within so much above or below each of them. Borders of tiles "
                  "and of the model's own triangles still meet. 0 leaves all."),
       number_key("margin_m", terrain.margin_m, {0, 10000}, "m",
                  "How far a ground made by this program reaches beyond the buildings."),
       number_key("map_reach_m", terrain.map_reach_m, {0, 10000}, "m",
                  "Where the city is the map alone: how far at most its ground reaches beyond "
                  "the tiles that its buildings lie in, to hold the map's streets, tracks and "
                  "trees, as far as `[ground]` asks for them, and `margin_m` beyond those. 0: no "
                  "farther than `margin_m` beyond the buildings.")}};
}

Table make_ground_table(bake::CoverOptions& ground) {
  return {
      "ground",
      "What lies and stands on the ground, from the map. The ground's triangles are cut along the "
      "outlines, "
      "so that no two surfaces lie in one place.",
      {flag_key("streets", ground.streets,
                "Streets as surfaces, where the city model has no roads of its own: "
                "carriageways, cycle tracks, pavements and paths. Widths are those that lamps "
                "and traffic use; `sidewalk` and `cycleway` say what runs beside a carriageway, "
                "else the class of the road; `surface` decides how much light it reflects. "
                "Carriageways of towns lie 0.12 m below the ground around them, between kerbs, "
                "and what stands or drives on them does so too. Tunnels are left out, and "
                "counted. Bridges: see `bridges`."),
       flag_key("markings", ground.markings,
                "With `streets`: paint on carriageways. Bars where `crossing` or "
                "`crossing:markings` says that a way is a marked crossing, lines between lanes of "
                "roads that have some, and lines across the lanes that face a node with "
                "`highway=stop`, `give_way` or `traffic_signals`: as `direction` or "
                "`traffic_signals:direction` says, else towards the nearest junction. Vehicles "
                "keep to the side that `[traffic] side` or the country says. A node with "
                "`highway=crossing` that says so has bars where no way says what is painted."),
       flag_key("lowered_kerbs", ground.lowered_kerbs,
                "With `streets`: the ground beside a street with kerbs comes down to 0.03 m above "
                "the carriageway where people cross, at nodes with `highway=crossing` and those of "
                "a crossing's way (`footway=crossing` and the like), along 4 m, with slopes of 6 % "
                "behind (DIN 18040-3). `kerb=raised` leaves the kerb, `flush` and `no` take it "
                "away. In the middle of junctions there are none."),
       flag_key("rounded_corners", ground.rounded_corners,
                "With `streets`: kerbs go round the corners of junctions in arcs, of 6 m between "
                "main roads and 4 m elsewhere, and so do the outer edges of pavements. Arms that "
                "meet at less than 45 degrees have an island between them and none."),
       flag_key(
           "parking", ground.parking,
           "With `streets`: where cars park along them, as `parking:left`, `right`, `both` or "
           "the older `parking:lane:...` say. Bays beside a carriageway (`street_side`) widen "
           "it, except within 5 m of junctions; on a pavement (`on_kerb`, `half_on_kerb`) it is "
           "at least as wide as cars need; `lane` and half of `half_on_kerb` widen a carriageway "
           "that has no `width`, and lanes lie beside the cars. `:orientation`, `:width` and "
           "`:surface` say what bays are like, else they are 2.00 m deep, 4.60 m if diagonal and "
           "4.30 m if perpendicular; with `markings` and "
           "`:markings = yes` there are lines between them."),
       flag_key(
           "rails", ground.rails,
           "Tracks of `railway`, where the city model has no roads of its own: two rails of "
           "steel, flush with what lies there, `gauge` apart, and below them a bed of "
           "ballast, or of what `surface` says, such as grass. What runs in a street or has "
           "`embedded` has rails alone. Left out, and counted in metres: tunnels and what else "
           "lies below ground, bridges that lie on the ground here and carry no street, and tracks "
           "that are disused or gone."),
       flag_key(
           "bridges", ground.bridges,
           "With `streets`: bridges of the map as decks above the ground, where the city "
           "model has no bridges of its own. Streets, paths and, with `rails`, tracks run on "
           "them, and so do vehicles and lamps. A deck goes from abutment to abutment and "
           "rises above what it crosses (docs/recipe.md, Bridges). One that would be too steep "
           "lies on the ground as if it were none, and is counted with the reason; so does "
           "every bridge if this is `false`."),
       flag_key(
           "land", ground.land,
           "Land, where the city model has neither land use nor water of its own: areas of "
           "`natural`, `landuse`, `landcover`, `leisure`, `waterway`, `amenity`, "
           "`area:highway` and the like as water, woods, grass, fields, sand, paved yards and "
           "squares, multipolygons with their holes too. Rivers, streams and canals that are "
           "lines are water as wide as `width` or `est_width` says, else as their kind usually "
           "is. The sea lies on the right of `natural = coastline`, as far as the ground or, "
           "where a coast ends before it, the map's bounds reach; coasts that end within these "
           "are counted in metres. Built-up land (`landuse = residential`) says nothing about "
           "the ground, which stays bare."),
       flag_key("gaps", ground.gaps,
                "Where the map has a building and the city model has none, the map's stands there, "
                "made as by `[osm] buildings` and on the lowest ground below it. A building of "
                "which a tenth lies on the model's own is the model's."),
       flag_key("barriers", ground.barriers,
                "Barriers of the map, which cast shadows: walls, hedges, fences and guard rails. "
                "`height`, `width`, `material`, `wall` and `fence_type` say what they are like, "
                "else a table (docs/recipe.md, Barriers). Light passes fences as it passes their "
                "gaps. They are open at gates and where a path meets them, and stand neither on "
                "carriageways nor in buildings."),
       flag_key("steps", ground.steps,
                "With `streets`: steps of the map (`highway=steps`), where the city model has no "
                "roads of its own: treads and risers between the heights that the ground has at "
                "their ends, as many as `step_count` says, else 0.16 m high. Where the ground "
                "rises by less than 0.08 m or 1 in 20, or as steeply as a ladder, they are a "
                "path, and counted in metres."),
       flag_key("horizon", ground.horizon,
                "Bare ground from the edge of the city's own to the horizon, 50 km away, as the "
                "earth curves: it begins at the height of the edge and levels out to the mean of "
                "it. Cameras see it, and it casts no shadow. Scenes are framed without it, and 3D "
                "Tiles do not have it."),
       choice_key<trees::Season>(
           "trees", ground.trees,
           {{"summer", trees::Season::summer},
            {"winter", trees::Season::winter},
            {"none", trees::Season::none}},
           "Trees of the map, which cast shadows: `natural=tree`, rows of trees, one every 8 m, "
           "and woods, one in each square of 7 m; and those of the model (`[city] vegetation`). "
           "`height` (else `est_height`) and `diameter_crown` say how large they are, else a "
           "guess. Light passes the gaps of their crowns: 3.3 % of what falls on a crown with "
           "leaves, 46 % in winter, when only evergreens stay green, by `leaf_cycle`, `leaf_type` "
           "and the genus or a name (`species`, `taxon`, `genus`, also `genus:de`), of woods too. "
           "`none`: no trees, of the map or of the model.")}};
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
