// The tables [terrain] and [ground] of a recipe.
#include "tools/bake/recipe/tables.h"
#include "tools/terrain/raster_names.h"

namespace nightcity::recipe {

Table make_terrain_table(bake::GroundOptions& terrain, const std::filesystem::path& folder) {
  return {
      "terrain",
      "The ground of a city where its model has no relief.",
      {paths_key(
           "dem", terrain.elevation_models, folder, {.expand = terrain::list_raster_files},
           R"(["heights.tif", "tiles.7z"])",
           "Digital elevation models in a raster format that GDAL reads, except those "
           "that lead to other files or the network (VRT, WMS), and in GSI's of Japan "
           "(FG-GML-...-DEM...xml). A folder stands for the rasters "
           "in it and in the folders inside it, an archive for those in it with their .tfw, .prj "
           "or .hdr (a text in it is one where nothing else is), and a stream is unpacked "
           "(docs/recipe.md, Packed files). Rasters that "
           "come beside heights and say how good they are (`_HEM`, `_num`, ...) are passed over, "
           "with a note. Where several have a height the finest decides, of about equally fine "
           "ones the first, and between tiles that meet both do. Their heights are moved to meet "
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
                   "A limit: the bake ends where the elevation models in archives and "
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
                  "How far a ground made by this program reaches beyond the buildings. One on "
                  "elevation models also lies between buildings that are up to 1 km apart."),
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
      "outlines, so that no two surfaces lie in one place.",
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

}  // namespace nightcity::recipe
