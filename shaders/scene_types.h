// The scene on the device: materials, lights and the tables they are sampled from, vehicles, the
// sky.
#ifndef NIGHTCITY_SHADERS_SCENE_TYPES_H
#define NIGHTCITY_SHADERS_SCENE_TYPES_H

#include "formats/night.h"
#include "shaders/bvh_types.h"

#ifdef __cplusplus
namespace nightcity::gpu {
#endif

#define MOON_RADIUS 0.0045f  // seen from the earth, radians

#define WATER_ROUGHNESS 0.1f  // smoother materials are water: they always have its film

struct Material {
  vec3 base_colour;  // linear Rec. 709 reflectance
  float roughness;
  vec3 emission;  // cd/m^2 per channel
  uint texture;   // 1 + index of its texture; 0 = none; PANE
};
#define PANE 0xFFFFFFFFu  // the pane of a window, through which a room is seen

// A surface under a texture keeps its reflectance, and not its material, in the word that says
// which material it is of: this bit, and 10 bits a channel (materials.glsl). Such surfaces neither
// shine nor mirror.
#define MATERIAL_IS_COLOUR 0x80000000u
// The steps of a channel, in sRGB's transfer function: four to each of a picture's, so that those
// are kept exactly.
#define COLOUR_STEPS 1020

#define TEXTURE_LEVELS 3u  // baked pictures have room for so many around their parts (SPEC.md)

#define WRAP_REPEAT 0u
#define WRAP_CLAMP 1u
#define WRAP_MIRROR 2u

// A picture and its smaller levels, each half as wide and high, from `first` on.
struct Texture {
  uint first;  // word of its upper left texel; a texel is red, green and blue from the low bits on
  uint width, height, levels;
  vec3 factor;
  uint wrap;  // WRAP_* in u, and in v from bit 2 on
};

// The texture coordinates of a triangle's corners; not a number where it has none.
struct TextureCorners {
  vec2 a, b, c;
};

// Entry of an alias table, which samples lights by flux (Walker 1977; Vose 1991).
struct AliasEntry {
  float keep;  // probability of keeping this column; else `alias` is taken
  uint alias;
};

// A map grid over the lights (runtime/scene/light_grid.h); width 0 = no light shines.
struct LightGridShape {
  float origin_x, origin_z;  // corner, model space, m
  float cell_m;
  float softening_m2;
  uint width, depth;  // cells along X, Z
};

// A cell's strongest lights: entries first .. first + count, all those whose strength is at least
// `threshold`.
struct LightCell {
  uint first;
  uint count;
  float strength_sum;
  float threshold;
};

// A column of a cell's alias table, with indices of lights.
struct GridEntry {
  uint light;
  float keep;
  uint alias_light;
};

// A kind of vehicle: its BLAS and its box in the vehicle frame. 32 bytes.
struct VehicleBody {
  vec3 lower;
  uint root;  // or BVH_EMPTY
  vec3 upper;
  uint mask;  // MASK_*
};

// A node of a light BVH: the box and the flux of everything below it. Leaves come first, in Morton
// order, and a node has four of the level below. There are two: over the vehicles that are on the
// road (vehicle_bvh.comp), and over the lights that do not move
// (runtime/scene/light_tree.h). 32 bytes.
struct LightNode {
  vec3 lower;  // lower > upper: nothing below
  float flux_lm;
  vec3 upper;
  uint item;  // of a leaf: trip or light
};
#define LIGHT_TREE_LEVELS 16  // 4^15 lights
#define VEHICLE_LEVELS 12     // 4^11 trips
// Vehicles are sorted by square cells of the map in Morton order, at most this many a side.
#define MAX_VEHICLE_CELLS_PER_SIDE 256u

#ifdef __cplusplus
static_assert(sizeof(Texture) == 32 && sizeof(TextureCorners) == 24);
static_assert(sizeof(Material) == 32 && sizeof(VehicleBody) == 32 && sizeof(LightNode) == 32);
}  // namespace nightcity::gpu
#endif

ARRAY_REFERENCE_16(Materials, Material, readonly)
ARRAY_REFERENCE_16(Textures, Texture, readonly)
ARRAY_REFERENCE(CornersOfTriangles, TextureCorners, readonly)
ARRAY_REFERENCE_16(Lights, Light, readonly)
ARRAY_REFERENCE_16(Profiles, LightProfile, readonly)
ARRAY_REFERENCE(Floats, float, readonly)
ARRAY_REFERENCE(Words, uint, )
ARRAY_REFERENCE(AliasTable, AliasEntry, readonly)
ARRAY_REFERENCE_16(Cells, LightCell, readonly)
ARRAY_REFERENCE(GridEntries, GridEntry, readonly)
ARRAY_REFERENCE_16(Vehicles, VehicleKind, readonly)
ARRAY_REFERENCE_16(Bodies, VehicleBody, readonly)
ARRAY_REFERENCE_16(Trips, Trip, readonly)
ARRAY_REFERENCE_16(Knots, TripKnot, readonly)
ARRAY_REFERENCE_16(LightNodes, LightNode, )
ARRAY_REFERENCE_16(VehicleLights, Light, )

#ifdef __cplusplus
namespace nightcity::gpu {
#endif

// The vehicles of a scene, and where each frame writes what becomes of them.
struct TrafficBuffers {
  BUFFER(Vehicles) vehicles;
  BUFFER(Bodies) bodies;          // parallel to vehicles
  BUFFER(Lights) vehicle_lights;  // in vehicle frames
  BUFFER(Trips) trips;
  BUFFER(Knots) knots;
  BUFFER(VehicleInstances) instances;  // one per trip, behind the static instances
  BUFFER(VehicleBvhNodes) bvh;         // over the vehicles, behind the static nodes
  uint trip_count;
  uint cells_per_side;  // vehicles that are not on the road are in one more, behind all others
  uint first_instance;  // index of the first trip's instance
  // Index of the first node over the vehicles. The last of these nodes is the root of the whole
  // scene.
  uint first_bvh_node;
  uint static_root;   // root of the TLAS over what does not move
  vec3 lower, upper;  // box of the static scene, in the frame of the TLAS's boxes
  // Levels of the light BVH over the vehicles; level 0 holds the leaves.
  uint level_first[VEHICLE_LEVELS];
  uint level_count[VEHICLE_LEVELS];
  uint levels;
  TrafficCycle cycle;
  // Used when the device's own structures are traced: TLAS_INSTANCE_WORDS per trip.
  BUFFER(Words) tlas_instances;
  BUFFER(Words) body_blas;  // addresses of the bodies' own structures, two words each
  uint has_tlas;
};

struct LightGridBuffers {
  LightGridShape shape;
  BUFFER(Cells) cells;  // row by row along Z, then X
  BUFFER(GridEntries) entries;
};

// The light BVH over the static lights that shine now, where a pass asks for it.
struct LightTree {
  BUFFER(LightNodes) nodes;
  uint level_first[LIGHT_TREE_LEVELS];
  uint level_count[LIGHT_TREE_LEVELS];
  uint levels;  // 0 = none shines
  BUFFER(Words) leaf_of_light;  // index of each static light's leaf; not set of lights that are off
};

// The scene on the device. It changes when another scene is loaded or lights are switched.
struct SceneBuffers {
  BUFFER(Nodes) nodes;
  BUFFER(Triangles) triangles;
  BUFFER(Instances) instances;
  BUFFER(Materials) materials;
  // These four are empty in scenes without textures.
  BUFFER(Textures) textures;
  BUFFER(Words) texels;
  BUFFER(CornersOfTriangles) texture_corners;  // parallel to triangles
  BUFFER(Floats) linear_of_step;               // of 0 .. COLOUR_STEPS, linear light
  BUFFER(Lights) lights;
  BUFFER(Profiles) profiles;
  BUFFER(Floats) profile_data;
  BUFFER(AliasTable) alias;
  // Latitude-longitude, RGB, cd/m^2; row 0 is the zenith, the middle column the north.
  BUFFER(Floats) sky_map;
  uint sky_width, sky_height;
  BUFFER(Words) lit;           // one bit per light: it shines now
  BUFFER(Words) lit_list;      // indices of the lights that shine now
  LightGridBuffers near_grid;  // lights that are strong near a place
  LightGridBuffers far_grid;   // lights of its neighbourhood
  uvec2 tlas;                  // address of the device's own TLAS, where that is traced
  uint root;                   // root of our own TLAS, or BVH_EMPTY
  Horizon horizon;
  vec2 boxes_along;            // x and z of the unit vector that boxes of the TLAS lie along
  float boxes_margin_m;        // by which they are wider than what they hold
  uint light_count;            // static lights, then VEHICLE_LIGHTS per trip
  uint static_lights;          // lights that do not move
  uint lit_count;              // static lights that shine now
  float lit_flux_lm;           // the sum of their flux: `alias` samples them in proportion to it
  LightTree light_tree;
  TrafficBuffers traffic;
};

#ifdef __cplusplus
}  // namespace nightcity::gpu
#endif

#endif
