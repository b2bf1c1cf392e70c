// What C++ hands to the shaders, and the records both read: included by both, in scalar block layout. Every buffer is
// reached by address, so a pass binds nothing: its push constants hold the address of one Frame.
#ifndef NIGHTCITY_SHADERS_INTERFACE_H
#define NIGHTCITY_SHADERS_INTERFACE_H

#include "formats/light.h"
#include "formats/night.h"

#ifdef __cplusplus
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
namespace nightcity::gpu {
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
#define BUFFER(type) std::uint64_t
#else
#define BUFFER(type) type
#endif

#define WORKGROUP_SIZE 8  // a pass over pixels runs in groups of 8 x 8
#define WORKGROUP_ROW 64  // a pass over a list, in groups of 64

// Estimators, as --estimator names them: DESIGN's ladder from the paper's weights to unbiased ones.
#define ESTIMATOR_REFERENCE 0u
#define ESTIMATOR_RIS 1u       // candidates only, no reuse
#define ESTIMATOR_PAPER 2u     // reuse with 1/M weights, as published: biased, darker
#define ESTIMATOR_BASIC 3u     // balance-heuristic normalisation of unshadowed targets
#define ESTIMATOR_PAIRWISE 4u  // pairwise MIS of unshadowed targets
#define ESTIMATOR_TRACED 5u    // pairwise MIS of shadowed targets: unbiased

// Specialization constants: what the scene contains and the user asked for, known before the shader is compiled.
#define CONSTANT_ESTIMATOR 0
#define CONSTANT_PROFILES 1    // some lamp has a luminaire profile
#define CONSTANT_RECTANGLES 2  // some light is a window
#define CONSTANT_VISIBILITY_REUSE \
  3                           // a candidate in shadow is dropped before reuse: less noise, biased
#define CONSTANT_SKY 4        // the sky shines: SKY_*
#define CONSTANT_SCHEDULES 5  // some light is not always on
#define CONSTANT_TRAFFIC 6    // vehicles are on their ways
#define CONSTANT_GLOSS 7      // surfaces that face up are wet
#define CONSTANT_LAYERS 8     // what each kind of light gives is kept apart
#define CONSTANT_COUNT 9

#define MOON_RADIUS 0.0045f  // as seen from the earth, radians
#define SKY_DARK 0u
#define SKY_UNIFORM 1u  // or dark with a moon
#define SKY_MAP 2u

// The all-lights reference is dispatched in chunks: Mesa's CPU driver of Debian 12 silently ends loops after 65,535
// iterations summed over one invocation (measured), and a shadow ray takes some tens of them.
#define REFERENCE_CHUNK 128u
#define REFERENCE_CLOSE 4u        // points on a light that is within four of its radii,
#define REFERENCE_MOST_CLOSE 32u  // on so many of a chunk: the steps above stay bounded

#define NO_HIT 0xFFFFFFFFu
#define NO_PERMUTATION 0xFFFFFFFFu

// A node of the bounding volume hierarchy: up to four children, their boxes quantised to 8 bits about `origin` with a
// power-of-two step an axis. Rounded outwards, so a child's box holds the child. 64 bytes: four 16-byte loads.
// (Wide quantised nodes after Ylitie, Karras, Laine: Efficient Incoherent Ray Traversal on GPUs, HPG 2017.)
struct BvhNode {
  vec3 origin;
  uint exponents;  // step = 2^(byte - 127) for x, y, z in the low three bytes
  uint lower[3];   // x, y, z: one byte a child
  uint upper[3];
  uint child
      [4];  // BVH_EMPTY, an inner node's index, or a leaf: BVH_LEAF | (count - 1) << 27 | first
  uint
      masks;  // one byte a child: MASK_* of the instances below, every bit within a mesh, 0 where there is no child
  uint pad;
};
#define BVH_EMPTY 0xFFFFFFFFu
#define BVH_LEAF 0x80000000u
#define BVH_LEAF_COUNT_SHIFT 27
#define BVH_LEAF_FIRST_MASK 0x07FFFFFFu  // 134 million triangles
#define BVH_MAX_LEAF 8
#define BVH_STACK 80  // entries a ray may defer; the builder keeps to it

// Three corners in the mesh's own frame and what they belong to.
struct Triangle {
  vec3 v0;
  uint material;
  vec3 v1;
  uint feature;  // city object, or NO_HIT
  vec3 v2;
  uint light;  // emitter geometry of this light, or NO_HIT
};

// One placing of a bottom-level hierarchy. Rows of the affine map from model space to the mesh's frame.
struct Instance {
  vec4 to_object[3];
  uint
      root;  // node index of the mesh's hierarchy; where rays go through acceleration structures, its first triangle
  uint mask;  // MASK_*
  uint
      light;  // whose luminous part it shows, or NO_HIT: then the triangles' own light (counted from here: MASK_VEHICLE)
  uint feature;  // or NO_HIT: then the triangles' own
};
#define MASK_SHADOW 1u   // stops shadow rays
#define MASK_VISIBLE 2u  // seen by the eye
#define MASK_VEHICLE 4u    // a vehicle: its triangles' lights count from the instance's

struct Material {
  vec3 base_colour;  // linear Rec. 709 reflectance
  float roughness;
  vec3 emission;  // cd/m^2 per channel
  uint flags;
};

// Alias-table entry for picking lights by flux (Walker 1977; Vose 1991).
struct AliasEntry {
  float keep;  // probability of keeping this column, else take `alias`
  uint alias;
  float pdf;  // probability of this light
};

// A map grid over the lights (runtime/scene/light_grid.h); width 0 = no light shines.
struct LightGridShape {
  float origin_x, origin_z;  // corner, model space, m
  float cell_m;
  float softening_m2;
  uint width, depth;  // cells along X, Z
};

// A cell's strongest lights: entries first .. first + count, those of at least `threshold` strength.
struct LightCell {
  uint first;
  uint count;
  float strength_sum;
  float threshold;
};

// A column of a cell's alias table, with lights for indices.
struct GridEntry {
  uint light;
  float keep;
  uint alias_light;
};

// A kind of vehicle's bottom-level hierarchy and its box in the vehicle frame. 32 bytes.
struct VehicleBody {
  vec3 lower;
  uint root;  // or BVH_EMPTY
  vec3 upper;
  uint mask;  // MASK_*
};

// A node of the tree over the vehicles that are on the road, in Morton order (shaders/trip_pose.glsl): the box and the flux
// of what is below. The first entries, one a trip, are its leaves. 32 bytes.
struct VehicleNode {
  vec3 lower;  // lower > upper: nothing below
  float flux_lm;
  vec3 upper;
  uint trip;  // of a leaf
};
#define VEHICLE_LEVELS 12           // 4^11 trips
#define VEHICLE_CELLS 65536u        // of the map, in Morton order: 256 x 256
#define VEHICLE_ABSENT VEHICLE_CELLS  // where those not on the road are sorted to

// What the eye sees in a pixel. 44 bytes.
struct Surface {
  vec3 position;  // model space, m
  uint normal;    // octahedral, 2 x 16 bits; towards the eye
  float depth;    // distance from the eye, m; 0 = nothing hit
  uint material;
  uint feature;
  uint light;   // emitter seen directly, or NO_HIT
  vec3 motion;  // to where this point of the surface was a frame ago, m
};

// A reservoir keeps the point it sampled: light, and where on it. 16 bytes, as in the paper.
struct Reservoir {
  uint light;  // NO_HIT = empty
  uint uv;     // 2 x 16 bits; cell centres of a 65536 x 65536 grid
  float M;     // confidence: candidates seen, capped
  float W;     // unbiased contribution weight
};

struct Accumulation {
  vec3 sum;  // cd/m^2 per channel, summed over frames
  float frames;
  vec3 compensation;        // Kahan's low-order part of `sum`
  float luminance_squared;  // sum of squared luminance, for the variance of the mean
};

// A pixel's light by where it comes from, cd/m^2 per channel, summed over frames.
struct LightLayers {
  vec3 lamps;
  vec3 windows;
  vec3 vehicles;
  vec3 sky;
  vec3 emitted;  // by the surface itself
};

// A pixel on its way through the denoiser: light over albedo, so that the filter spares what is drawn on the surfaces.
struct Demodulated {
  vec3 irradiance;
  float variance;  // of its luminance
};
#define DENOISE_LEVELS 5

// A light's flux that leaves the scene, as shares of it, summed over rays (upward.comp).
struct Escape {
  float direct;     // upwards, without touching anything
  float reflected;  // upwards, off the first surface it met
  float sideways;   // level or downwards past the scene's edge: neither up nor on the ground
};

struct Camera {
  vec3 position;
  float tan_half_height;  // of the vertical field of view
  vec3 right;             // unit, right-handed: cross(forward, up)
  float aspect;           // width / height
  vec3 up;
  float pad0;
  vec3 forward;
  float pad1;
};

#ifndef __cplusplus
#define REFERENCE_TO(name, type, access)                                            \
  layout(buffer_reference, scalar, buffer_reference_align = 4) access buffer name { \
    type at[];                                                                      \
  }
// Traversal reads nodes and triangles as 16-byte words: four and three loads.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Nodes {
  uvec4 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Triangles {
  vec4 at[];
};
REFERENCE_TO(Instances, Instance, readonly);
REFERENCE_TO(Materials, Material, readonly);
REFERENCE_TO(Lights, Light, readonly);
REFERENCE_TO(Profiles, LightProfile, readonly);
REFERENCE_TO(Floats, float, readonly);
REFERENCE_TO(AliasTable, AliasEntry, readonly);
REFERENCE_TO(Cells, LightCell, readonly);
REFERENCE_TO(GridEntries, GridEntry, readonly);
REFERENCE_TO(Vehicles, VehicleKind, readonly);
REFERENCE_TO(Bodies, VehicleBody, readonly);
REFERENCE_TO(Trips, Trip, readonly);
REFERENCE_TO(Knots, TripKnot, readonly);
REFERENCE_TO(VehicleNodes, VehicleNode, );
REFERENCE_TO(VehicleLights, Light, );
REFERENCE_TO(VehicleInstances, Instance, writeonly);
REFERENCE_TO(VehicleBvhNodes, BvhNode, writeonly);
REFERENCE_TO(Surfaces, Surface, );
REFERENCE_TO(Reservoirs, Reservoir, );
REFERENCE_TO(Accumulations, Accumulation, );
REFERENCE_TO(Layers, LightLayers, );
REFERENCE_TO(Escapes, Escape, );
REFERENCE_TO(DemodulatedPixels, Demodulated, );
REFERENCE_TO(Words, uint, );
#endif

// The vehicles of a scene and where what they become each frame is put.
struct TrafficBuffers {
  BUFFER(Vehicles) vehicles;
  BUFFER(Bodies) bodies;          // parallel to vehicles
  BUFFER(Lights) vehicle_lights;  // in vehicle frames
  BUFFER(Trips) trips;
  BUFFER(Knots) knots;
  BUFFER(VehicleInstances) instances;  // of the trips, behind the standing ones
  BUFFER(VehicleBvhNodes) bvh;         // of the fleet, behind the standing ones
  uint trip_count;
  uint first_instance;  // index of the first trip's instance
  uint
      first_bvh_node;  // index of the fleet's first node; its root's parent, the scene's root, is the last
  uint static_root;              // of what does not move
  vec3 lower, upper;               // the standing scene's box
  uint level_first[VEHICLE_LEVELS];  // in the fleet's tree: leaves are level 0
  uint level_count[VEHICLE_LEVELS];
  uint levels;
  TrafficCycle cycle;
  BUFFER(Words)
  tlas_instances;  // TLAS_INSTANCE_WORDS a trip of the acceleration structure, where rays go through one
  BUFFER(Words) body_blas;  // addresses of the bodies' acceleration structures, two words each
  uint has_tlas;
};
#define TLAS_INSTANCE_WORDS 16u  // of VkAccelerationStructureInstanceKHR

struct LightGridBuffers {
  LightGridShape shape;
  BUFFER(Cells) cells;  // row by row along Z, then X
  BUFFER(GridEntries) entries;
};

// The scene on the device; changes when another scene is loaded or lights are switched.
struct SceneBuffers {
  BUFFER(Nodes) nodes;
  BUFFER(Triangles) triangles;
  BUFFER(Instances) instances;
  BUFFER(Materials) materials;
  BUFFER(Lights) lights;
  BUFFER(Profiles) profiles;
  BUFFER(Floats) profile_data;
  BUFFER(AliasTable) alias;
  BUFFER(Floats)
  sky_map;  // latitude-longitude, RGB, cd/m^2; row 0 is the zenith, its middle column the north
  uint sky_width, sky_height;
  BUFFER(Words) lit;            // a bit a light: shines now
  BUFFER(Words) lit_list;       // indices of those
  LightGridBuffers near_grid;  // lights that are strong near a place
  LightGridBuffers far_grid;   // lights of its quarter
  uvec2 tlas;        // address of the top-level acceleration structure, where rays go through one
  uint root;         // of our own top-level hierarchy, or BVH_EMPTY
  uint light_count;  // standing lights, then VEHICLE_LIGHTS a trip
  uint static_lights;
  uint lit_count;  // standing lights that shine now
  TrafficBuffers traffic;
};

// Where upward flux leaves: a map of squares, and what is counted there.
struct UpwardMap {
  BUFFER(Escapes) escapes;  // a light
  BUFFER(Words)
  cells;  // 1/1024 lumen, by place of the last surface: whole numbers, so that no order of adding changes them
  float origin_x, origin_z, cell_m;
  uint width, depth;
  uint rays;  // a light in all
};

// Everything a frame's passes read and write.
struct Frame {
  SceneBuffers scene;
  BUFFER(Words) previous_lit;        // scene.lit of the frame before
  BUFFER(VehicleLights) vehicle_lights;  // VEHICLE_LIGHTS a trip, in model space
  BUFFER(VehicleLights) previous_vehicle_lights;
  BUFFER(VehicleNodes) vehicle_nodes;
  BUFFER(Words) vehicle_cells;       // a trip's cell, and its place among those of the cell
  BUFFER(Words) vehicle_counts;      // a cell's number of vehicles, then its first place in the order
  BUFFER(VehicleNodes) vehicle_boxes;  // a leaf a trip, not yet in order
  BUFFER(Surfaces) surfaces;       // of this frame
  BUFFER(Surfaces) previous_surfaces;
  BUFFER(Reservoirs) reservoirs;  // candidates', then temporal's result
  BUFFER(Reservoirs) spatial;     // spatial's result: shaded, and next frame's history
  BUFFER(Reservoirs) previous_reservoirs;
  BUFFER(Accumulations)
  radiance;  // this frame's estimate; the reference's sums over chunks of lights, slice by slice
  BUFFER(Accumulations) accumulation;
  BUFFER(Accumulations) previous_accumulation;
  BUFFER(Layers) layers;
  BUFFER(DemodulatedPixels) denoise[2];
  BUFFER(Words) display;  // 8-bit sRGB, R in the low byte
  Camera camera;
  Camera previous_camera;
  uvec2 size;
  uint frame;  // counts from 0 since the accumulation began
  uint seed;
  uint candidates;
  uint neighbours;
  float neighbour_radius;  // pixels
  float max_history;       // M of the history at most this many times the candidates' M
  float
      history_falloff;  // 1/m^2: how fast the history's M fades with the way to the place it was gathered at, 0 = not
  uint disocclusion_boost;           // neighbours of a pixel that has no history, where that is more
  uint permutation;     // of the history: corner of the blocks, x | y << 2, or NO_PERMUTATION
  float uniform_share;  // of candidates picked uniformly
  float near_share;    // of candidates picked from the local grid's cell
  float far_share;     // of candidates picked from the wide grid's; the rest by flux
  float
      vehicle_share;  // of all candidates, picked from vehicles' lights; the shares above are of the others
  float time_s, previous_time_s;              // since noon
  float cycle_time_s, previous_cycle_time_s;  // within the traffic's cycle
  uint has_history;                           // previous_* hold a frame of this scene
  float jitter_x, jitter_y;                   // sub-pixel offset of this frame's rays, in [0, 1)
  float exposure;                             // display: exposed value of 1 cd/m^2
  uint reset;                                 // 1: this frame starts a new accumulation
  uint
      slices;  // pictures in `radiance` to be added up: chunks of lights that one dispatch works at side by side
  uint
      window;  // mean of at most so many frames, carried along by motion; 0 = of all, while nothing moves
  float wetness;  // of surfaces that face up, 0 .. 1
  vec3
      sky;  // luminance of directions that leave the scene, cd/m^2 per channel: uniform, or the map's factor
  vec3 moon_direction;  // unit, towards it
  vec3 moon_lux;        // illuminance of a surface that faces it, per channel
  uint tone;            // display: TONEMAP_*
  UpwardMap upward;
};

#ifdef __cplusplus
// As the push constants in common.glsl.
struct Push {
  std::uint64_t frame;
  std::uint32_t first, count;  // reference: the lights of the dispatch
};

static_assert(sizeof(BvhNode) == 64 && sizeof(Triangle) == 48 && sizeof(Instance) == 64 &&
              sizeof(Material) == 32);
static_assert(sizeof(Surface) == 44 && sizeof(VehicleBody) == 32 && sizeof(VehicleNode) == 32 &&
              sizeof(Reservoir) == 16 && sizeof(Accumulation) == 32 && sizeof(Push) == 16);
}  // namespace nightcity::gpu
#endif

#endif
