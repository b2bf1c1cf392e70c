// Everything one frame's passes read and write: buffers of records, the camera, and the settings.
#ifndef NIGHTCITY_SHADERS_FRAME_H
#define NIGHTCITY_SHADERS_FRAME_H

#include "shaders/records.h"

#ifdef __cplusplus
namespace nightcity::gpu {
#endif

#define PROJECTION_PERSPECTIVE 0u
#define PROJECTION_FISHEYE 1u          // equidistant, a hemisphere across the shorter side
#define PROJECTION_EQUIRECTANGULAR 2u  // all directions: longitude by latitude

struct Camera {
  vec3 position;
  float tan_half_height;  // of the vertical field of view
  vec3 right;             // unit, right-handed: cross(forward, up)
  float aspect;           // width / height
  vec3 up;
  uint projection;  // PROJECTION_*
  vec3 forward;
  float pad1;
};

#define NO_PERMUTATION 0xFFFFFFFFu

// The map of squares in which upward flux is counted where it leaves the scene.
struct UpwardMap {
  BUFFER(Escapes) escapes;  // one per light
  // 1/1024 lumen, by the place of the last surface. Whole numbers, so that the order of adding
  // changes nothing.
  BUFFER(Words) cells;
  float origin_x, origin_z, cell_m;
  uint width, depth;
  uint rays;  // per light, over all dispatches
};

// The rays that are traced for their time.
struct RayProbe {
  BUFFER(ProbeRays) rays;
  BUFFER(Targets) distances;  // of their hits, in units of `way`; 0 = any; -1 = none
};

// Air that scatters light (air.glsl).
struct Air {
  float extinction;  // at `level`, 1/m; 0 = clear
  float falloff;     // of the extinction with height, 1/m; 0 = the same at all heights
  float level;       // height at which the extinction is given, model space, m
  float asymmetry;   // mean cosine of scattering angles
  float albedo;      // the share of the extinction that scatters
  uint candidates;   // per sample
  uint block;        // side of the blocks of pixels of which each frame samples one
};

#define MAX_GLARE_LEVELS 16

// The pyramid of the glare (glare.glsl). Level 0 is the picture.
struct Glare {
  BUFFER(Colours) levels;  // from level 1
  uvec2 size[MAX_GLARE_LEVELS];
  uint first[MAX_GLARE_LEVELS];    // index of a level's first pixel in `levels`
  float weight[MAX_GLARE_LEVELS];  // of a level in the light that is seen
  uint last;                       // level
  uint pad;  // C++ rounds a size up to the alignment, the shaders' scalar layout does not
};

struct Frame {
  SceneBuffers scene;
  BUFFER(Words) previous_lit;            // scene.lit of the frame before
  BUFFER(VehicleLights) vehicle_lights;  // VEHICLE_LIGHTS per trip, in model space
  BUFFER(VehicleLights) previous_vehicle_lights;
  BUFFER(LightNodes) vehicle_nodes;  // the light BVH over the vehicles
  BUFFER(Words) vehicle_cells;       // per trip: its cell, and its place among that cell's trips
  BUFFER(Words) vehicle_counts;      // per cell: number of vehicles, then first place in the order
  BUFFER(LightNodes) vehicle_boxes;  // one leaf per trip, not yet in order
  BUFFER(Surfaces) surfaces;         // of this frame
  BUFFER(Surfaces) previous_surfaces;
  BUFFER(Words) hits;  // each pixel's triangle and instance (NO_HIT: none), where keeps_hits is set
  BUFFER(Reservoirs) reservoirs;  // result of the candidates, then of temporal reuse
  BUFFER(Reservoirs) spatial;     // result of spatial reuse: shaded, and the next frame's history
  BUFFER(Reservoirs) previous_reservoirs;
  // Written by pair_targets.comp, a picture for each pairing: the pixel's partner, or NO_HIT.
  BUFFER(Words) pair_partners;
  // They say what the pixel reflects of its own sample and, a picture for each pairing, of its
  // partner's. Those of empty reservoirs are not written.
  BUFFER(ReflectedSamples) pair_samples;
  BUFFER(PixelBlocks) blocks;
  BUFFER(PixelBlocks) previous_blocks;
  BUFFER(PathVertices) path;  // of the reference
  BUFFER(IrradianceCells) cells;
  BUFFER(Words) seen_cells;  // their number, then the indices of the cells that this frame sees
  BUFFER(Words) uncached;    // the number of pixels whose indirect light it lacks, then these
  BUFFER(Words) ray_count;   // shadow rays of the frame, where COUNT_RAYS is set
  // This frame's estimate. The reference's: sums over chunks of lights, one picture per slice.
  BUFFER(Accumulations) radiance;
  BUFFER(Accumulations) accumulation;
  BUFFER(Accumulations) previous_accumulation;
  BUFFER(Layers) layers;
  BUFFER(DemodulatedPixels) denoise[2];
  BUFFER(Words) display;  // 8-bit sRGB, R in the low byte
  Camera camera;
  Camera previous_camera;
  // scene.tlas and scene.root of the frame before.
  uvec2 previous_tlas;
  uint previous_root;
  uvec2 size;
  uvec2 previous_size;  // of previous_*
  // Number of the frame since the renderer was made. It never repeats, so that random numbers
  // differ in every frame.
  uint frame;
  uint seed;
  uint candidates;
  uint neighbours;
  float neighbour_radius;  // pixels
  float max_history;       // the history's M is at most this many times the candidates' M
  // Frames that are in the mean of a picture at rest before this one; 0 in any other picture.
  uint frames_at_rest;
  // The history's M fades with the squared distance to where it was gathered, 1/m^2; 0 = never.
  float history_falloff;
  // Neighbours of a pixel without history, where that is more than `neighbours`.
  uint disocclusion_boost;
  uint pairings;     // pairings of pixels in this frame (pairing.glsl)
  uint pair_block;   // side of the blocks within which pixels are paired: a power of two
  uint half_rate;    // 0 = all pixels are sampled; else 1 or 2: half_rate.glsl says which
  uint permutation;  // of the history: corner of the blocks, x | y << 2, or NO_PERMUTATION
  float faint_luminance;  // samples that show less, cd/m^2, play Russian roulette; 0 = none do
  // Shares of candidates by how they are sampled. vehicle_share is a share of all, sampled from
  // vehicles' lights. The others are shares of the rest: uniformly, from the near grid's cell, from
  // the far grid's cell; what then remains is sampled by flux.
  float uniform_share, near_share, far_share;
  float vehicle_share;
  float time_s, previous_time_s;              // since noon
  float cycle_time_s, previous_cycle_time_s;  // within the traffic's cycle
  uint has_history;                           // previous_* hold a frame of this scene
  float jitter_x, jitter_y;                   // sub-pixel offset of this frame's rays, in [0, 1)
  float exposure;                             // display: exposed value of 1 cd/m^2
  uint reset;                                 // 1: this frame starts a new accumulation
  // Pictures in `radiance` to be summed: chunks of lights that one dispatch works on side by side.
  uint slices;
  // The mean is over at most this many frames and moves with the surface; 0 = over all frames,
  // while nothing moves.
  uint window;
  uint bounces;          // of light before it reaches the surface that is seen, at most
  uint reference_paths;  // of a pixel in a frame of the reference
  uint cell_mask;        // number of cells, a power of two, less 1
  uint cell_paths;       // of a cell in a frame
  float cell_angle;      // side of a cell, m per m of distance from the camera
  // While the clock runs, cells forget: what was seen longer ago, in frames, is not used, and a
  // mean is over at most the samples of so many frames.
  uint cell_memory;
  float max_cell_samples;
  Air air;
  float wetness;  // of surfaces that face up, 0 .. 1
  // Luminance of directions that leave the scene, cd/m^2 per channel; with a sky map, its factor
  // and what is added to it above the horizon.
  vec3 sky, sky_base;
  vec3 moon_direction;  // unit, towards the moon
  vec3 moon_lux;        // illuminance of a surface that faces the moon, per channel
  uint tone;            // display: TONEMAP_*
  // Rows of the matrix from linear Rec. 709 to the same as the eye or camera is adapted.
  vec3 white_red, white_green, white_blue;
  Glare glare;
  uint view;  // display: VIEW_*, and the ends of its scale, above 0
  float view_lowest, view_highest;
  uint keeps_hits;
  BUFFER(Accumulations) reference;  // of VIEW_DIFFERENCE
  uvec2 reference_size;
  UpwardMap upward;
  RayProbe probe;
};

#ifdef __cplusplus
// The push constants of every pass, as common.glsl declares them.
struct Push {
  std::uint64_t frame;
  // By pass: the lights of a dispatch, the level of a filter or BVH, a path and its bounce.
  std::uint32_t first, count;
};
static_assert(offsetof(Glare, pad) + 4 == sizeof(Glare));
static_assert(sizeof(Push) == 16);
}  // namespace nightcity::gpu
#endif

#endif
