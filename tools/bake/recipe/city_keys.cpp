#include <array>

#include "tools/bake/recipe/tables.h"
#include "tools/inputs/city_files.h"

namespace nightcity::recipe {
namespace {

std::vector<georeference::CityFrame::ControlPoint> to_control_points(const Value& value) {
  const std::vector<Value> rows = value.elements(0, "a list of two or more [lon, lat, x, y]");
  if (rows.size() < 2) value.refuse("is not a list of two or more [lon, lat, x, y]");
  std::vector<georeference::CityFrame::ControlPoint> result;
  for (const Value& row : rows) {
    std::array<double, 4> v{};
    const std::vector<Value> numbers = row.elements(4, "a list of rows [lon, lat, x, y]");
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = numbers[i].number(-1e9, 1e9);
    result.push_back({{v[0], v[1]}, {v[2], v[3]}});
  }
  return result;
}

std::array<double, 4> to_bounds(const Value& value) {
  const std::vector<Value> numbers = value.elements(4, "[west, south, east, north]");
  std::array<double, 4> result{};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double max = i % 2 == 0 ? 180 : 90;
    result[i] = numbers[i].number(-max, max);
  }
  if (!(result[0] < result[2] && result[1] < result[3])) value.refuse("has no extent");
  return result;
}

Key control_points_key(georeference::CityFrame::Options& frame) {
  return {
      "control_points",
      "list of [lon, lat, x, y]",
      "",
      "degrees, m",
      "two or more rows",
      "[[13.0, 52.0, 0, 0], [13.1, 52.1, 6900, 11100]]",
      "Places a model that has no coordinate reference system: WGS 84 longitude and latitude of "
      "points whose x and y in the model are known. Excludes `bounds`.",
      [&frame](const Value& value) { frame.control_points = to_control_points(value); }};
}

Key bounds_key(std::optional<std::array<double, 4>>& bounds) {
  return {"bounds",
          "[west, south, east, north]",
          "",
          "degrees",
          "within -180 to 180, -90 to 90",
          "[13.385, 52.498, 13.409, 52.523]",
          "Places a model that has no coordinate reference system: the WGS 84 box that its "
          "geometry fills. All files are read once more to find their extent. Unless `crs` says "
          "otherwise, a system named by the files is ignored. Excludes `control_points`.",
          [&bounds](const Value& value) { bounds = to_bounds(value); }};
}

Key obj_origin_key(glm::dvec3& origin) {
  return {"obj_origin",
          "[easting, northing, height]",
          "[0, 0, 0]",
          "m",
          "",
          "[391000, 5819000, 35]",
          "Where the origin of Wavefront OBJ files lies in the system that `crs` names.",
          [&origin](const Value& value) {
            const std::vector<Value> numbers =
                value.elements(3, "a list of easting, northing and height");
            for (int i = 0; i < 3; ++i)
              origin[i] = numbers[static_cast<std::size_t>(i)].number(-1e9, 1e9);
          }};
}

}  // namespace

Table make_city_table(bake::Recipe::City& city, const std::filesystem::path& folder) {
  return {
      "city",
      "The city model.",
      {paths_key(
           "files", city.files, folder, {.expand = inputs::city_files},
           R"(["buildings", "terrain.gml.gz"])",
           "CityGML 1, 2 or 3, CityJSON 1.0 to 2.0 or CityJSONSeq and Wavefront OBJ files, plain "
           "or packed (docs/recipe.md, Packed files). Paths are relative to the recipe. A folder "
           "stands for the city files in it and in the folders inside it."),
       text_key("crs", city.frame.crs_override, "\"EPSG:25833\"",
                "Coordinate reference system of the files, in place of the one they name: an EPSG "
                "code or any text that PROJ understands. `\"none\"`: coordinates are metres of an "
                "unknown system. A name that is a URN or a URL fixes the order of axes, whichever "
                "way surfaces face; with `EPSG:n` area of use and surfaces decide. Where a file "
                "contradicts its name, a warning says what was taken."),
       control_points_key(city.frame),
       bounds_key(city.bounds),
       integer_key(
           "lod", city.read.max_lod, 0, 4,
           "The highest level of detail to use. Each object takes its highest one up to "
           "this, or its lowest one if all are higher. So does an object that several "
           "files or documents have in a level each, and of Wavefront OBJ files whose names "
           "differ in a level alone (`-LoD12`, `-LoD22`) one is read."),
       choice_key<city::Reader>(
           "reader", city.read.reader,
           {{"stream", city::Reader::stream}, {"libcitygml", city::Reader::libcitygml}},
           "Which CityGML reader to use. `stream` is faster, needs little memory and understands "
           "more; `libcitygml` is there to compare with (`nightbake readers`)."),
       integer_key("threads", city.read.threads, 0, 1024,
                   "Number of threads; 0 stands for one per core. The results do not depend on it. "
                   "`nightbake run --threads` overrides it."),
       number_key("tile_m", city.tile_m, {10, 10000}, "m",
                  "Edge of the square tiles that the geometry is batched into."),
       number_key(
           "simplify_m", city.simplify_m, {0, 10}, "m",
           "Straightens the outlines of buildings: a corner is left out where the edge that "
           "replaces its two passes it within so much, and every surface passes it alike, so "
           "that surfaces still meet. 0 leaves all, even those on a straight edge."),
       choice_key<city::MeshPlacement::Up>(
           "obj_up", city.read.mesh.up,
           {{"auto", city::MeshPlacement::Up::automatic},
            {"y", city::MeshPlacement::Up::y},
            {"z", city::MeshPlacement::Up::z}},
           "The axis of Wavefront OBJ files that points up. With `y` "
           "x is east and -z north. `auto`: the one of the two along "
           "which a file extends less, with a warning."),
       number_key("obj_unit_m", city.read.mesh.unit_m, {1e-6, 1e6}, "m",
                  "The unit of Wavefront OBJ files: 0.01 where they are in centimetres."),
       obj_origin_key(city.read.mesh.origin),
       integer_key(
           "obj_max_vertices", city.read.mesh.max_vertices, 1, 2'000'000'000,
           "A limit: the bake ends at a Wavefront OBJ of more vertices. One takes 24 bytes."),
       integer_key("max_member_mb", city.read.max_member_mb, 1, 65536,
                   "A limit: the bake ends at a member of the model (an object with all its parts; "
                   "in CityJSONSeq a line) that is longer, in MB of text. Reading takes some ten "
                   "times as much memory."),
       integer_key("max_linked_vertices", city.read.max_linked_vertices, 1, 1'000'000'000,
                   "A limit: links between the objects of a file are followed until they have led "
                   "to this many vertices, and to objects of 40 bytes of text for each. What lies "
                   "beyond is skipped and counted."),
       integer_key("max_crossings", city.read.polygon.max_crossings, 1, 1'000'000,
                   "A limit: a polygon whose outlines cross more often, for each of their points, "
                   "is left out and counted. Where streets come from the model's roads, more "
                   "crossings of all roads together end the bake."),
       integer_key("max_polygon_points", city.read.polygon.max_points, 3, 1'000'000'000,
                   "A limit: a polygon of more points, those of its holes included, is left out "
                   "and counted. Triangulating one takes some 400 bytes a point."),
       integer_key("max_road_points", city.max_road_points, 1, 1'000'000'000,
                   "A limit: where streets come from the model's roads, the bake ends if their "
                   "outlines have more points than this, 2.5 m apart. One takes some 200 bytes."),
       choice_key<city::Textures>(
           "textures", city.read.textures,
           {{"none", city::Textures::none},
            {"mean", city::Textures::mean},
            {"atlas", city::Textures::atlas}},
           "`mean`: surfaces of CityGML, CityJSON and Wavefront OBJ reflect the mean of the "
           "picture that the file lays on them, where that lies beside the file or below as PNG "
           "or JPEG. Pictures are unpacked within the budget that SECURITY.md states; how many, a "
           "note says. Colours have 32 steps a channel, and each is a material of its own. "
           "`atlas`: they reflect the picture itself, packed into a few for each tile. The walls "
           "of a building are made alike in mean luminance, and its roofs, so that the sun in the "
           "pictures is not the night's."),
       number_key("texels_per_m", city.texels_per_m, {0.1, 100}, "",
                  "`textures = \"atlas\"`: so many texels of a picture lie along a metre of a "
                  "surface, at most. Twice as many take four times the room."),
       integer_key("max_picture_mpx", city.max_picture_mpx, 1, 1'000'000,
                   "A limit: `textures = \"atlas\"` lays this many millions of texels onto the "
                   "surfaces of all objects together, each 3 bytes of the temporary folder. From "
                   "the first object on whose pictures do not fit, surfaces keep the mean colour, "
                   "and are counted."),
       flag_key("drop_ground", city.drop_ground,
                "Leaves out the ground surfaces under buildings, which nobody sees."),
       flag_key("drop_hidden", city.drop_hidden,
                "Leaves out walls between two closed buildings, and parts of buildings that lie "
                "below the ground."),
       flag_key("skins", city.skins,
                "Walls and roofs of buildings to which neither model nor map gives a colour "
                "reflect light as a finish does that is usual for their use and age "
                "(docs/recipe.md, Skins): plaster, brick, stone, concrete, sheet; tiles, tar and "
                "gravel. "
                "The building's id alone decides which, and which shade of it. `false`: all walls "
                "are of one grey (0.35), and all roofs (0.20)."),
       choice_key<bool>(
           "roads", city.drops_roads, {{"model", false}, {"map", true}},
           "Which roads stand where both the model and `[osm] files` have some. `model`: its "
           "own, and the map makes no streets, markings, bridges or tracks (`[ground]`). "
           "`map`: the roads of the model are left out, and counted, and those of the map "
           "stand with all that its tags say."),
       choice_key<trees::Vegetation>(
           "vegetation", city.vegetation,
           {{"trees", trees::Vegetation::trees},
            {"surfaces", trees::Vegetation::surfaces},
            {"none", trees::Vegetation::none}},
           "What stands for the model's vegetation. `trees`: each SolitaryVegetationObject that is "
           "1 m high or more is a tree as those of the map are, in the season of `[ground] "
           "trees`, as large as its attributes say, else as its surfaces are; a tree of the map "
           "within 4 m of it is left out. A PlantCover that is 3 m high or more is a wood, with a "
           "tree in each square of 7 m. Other vegetation is the surfaces that the model has. "
           "`surfaces`: all of it is, and no light passes them. `none`: "
           "there is none."),
       texts_key(
           "licence", city.licences, "\"Geoportal Berlin, dl-de/by-2-0\"",
           "The attribution of the model, one line or several. Both output files carry it.")}};
}

}  // namespace nightcity::recipe
