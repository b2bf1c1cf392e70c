// The records that passes keep of pixels, cells and rays.
#ifndef NIGHTCITY_SHADERS_RECORDS_H
#define NIGHTCITY_SHADERS_RECORDS_H

#include "shaders/scene_types.h"

#ifdef __cplusplus
namespace nightcity::gpu {
#endif

// The surface that the camera sees in a pixel. 48 bytes.
struct Surface {
  vec3 position;  // model space, m
  uint normal;    // octahedral, 2 x 16 bits (octahedral.glsl.h); towards the camera
  float depth;    // distance from the camera, m; 0 = nothing hit
  uint material;
  uint feature;
  uint light;   // light whose emitting surface is seen, or NO_HIT
  vec3 motion;  // from this point of the surface to where it was one frame ago, m
  // Upper 10 bits: the clearance (geometry.glsl) as the exponent and two more bits of a float, m;
  // lower 22: what `normal` rounded off, 2 x 11 bits.
  uint clearance_and_rest;
};

// A reservoir keeps the sample it selected: a light, and a point on it. 16 bytes, as in the paper.
struct Reservoir {
  uint light;  // NO_HIT = empty
  uint uv;     // 2 x 16 bits; cell centres of a 65536 x 65536 grid
  float M;     // confidence: number of candidates seen, capped
  float W;     // unbiased contribution weight
};

// A vertex of a path of light that bounced: where the reference stands on the path of a pixel.
struct PathVertex {
  Surface surface;  // depth 0 = the path has ended
  vec3 throughput;  // of the path up to here
  vec3 viewer;      // the vertex before, model space, m
};

// A cell of the irradiance cache (irradiance_cache.glsl). 32 bytes.
struct IrradianceCell {
  uint key;         // hash of what it stands for; 0 = free
  uint owner;       // of this frame: encoded index of the pixel whose surface samples it, or 0
  uint seen;        // 1 + number of the last frame that saw it
  float samples;    // in the mean
  vec3 irradiance;  // mean of the indirect illuminance, lux per channel
  uint made;        // 1 + number of the frame that made it
};

// A pixel's sum over frames, compensated after Kahan (accumulation.glsl).
struct Accumulation {
  vec3 sum;  // cd/m^2 per channel
  float frames;
  vec3 compensation;        // low-order part that `sum` has no room for
  float luminance_squared;  // sum of squared luminance, for the variance of the mean
};

// A pixel's light by where it comes from, cd/m^2 per channel.
struct LightLayers {
  vec3 lamps;
  vec3 windows;
  vec3 vehicles;
  vec3 sky;
  vec3 emitted;   // by the surface itself
  vec3 air;       // of any source, scattered by the air in front of the surface
  vec3 indirect;  // of any source, after a bounce at least
};

// A pixel's layers summed over frames, compensated as Accumulation is.
struct LayerSums {
  LightLayers sum;
  LightLayers compensation;
};

// A pixel inside the denoiser: light divided by albedo, so that the filter keeps what is drawn on
// the surfaces.
struct Demodulated {
  vec3 irradiance;
  float variance;  // of its luminance
};

// The flux of a light that leaves the scene, as shares of its flux, summed over rays (upward.comp).
struct Escape {
  float direct;     // upwards, without touching anything
  float reflected;  // upwards, off surfaces that were hit
  float sideways;   // level or downwards past the scene's edge: neither up nor onto the ground
};

// A record of what the pixels of a square of WORKGROUP_SIZE^2 showed; blocks.glsl reads and writes
// it.
struct PixelBlock {
  uint is_lit;  // 1 = one of them showed more than is nearly black
  uint tested;  // tests of strong lights for shadow, in multiples of ONE_TEST
  uint hidden;  // those of them that met one
};

// Tells what a surface reflects of a sample towards the viewer. 16 bytes.
struct ReflectedSample {
  vec3 in_clear_air;  // cd/m^2 per unit of uv: its luminance is the target function
  float passed;       // the share that the air between light and surface lets pass
};

// A ray of a list (rays.comp).
struct ProbeRay {
  vec3 from;    // model space, m
  float t_max;  // its length, in units of `way`
  vec3 way;
  uint pad;
};

#ifdef __cplusplus
static_assert(sizeof(IrradianceCell) == 32);
static_assert(sizeof(Surface) == 48 && sizeof(Reservoir) == 16 && sizeof(Accumulation) == 32);
static_assert(sizeof(ProbeRay) == 32);
}  // namespace nightcity::gpu
#endif

ARRAY_REFERENCE_16(Surfaces, Surface, )
ARRAY_REFERENCE_16(Reservoirs, Reservoir, )
ARRAY_REFERENCE(Targets, float, )
ARRAY_REFERENCE_16(ReflectedSamples, ReflectedSample, )
ARRAY_REFERENCE_16(ProbeRays, ProbeRay, readonly)
ARRAY_REFERENCE(PixelBlocks, PixelBlock, )
ARRAY_REFERENCE(PathVertices, PathVertex, )
ARRAY_REFERENCE_16(IrradianceCells, IrradianceCell, )
ARRAY_REFERENCE_16(Accumulations, Accumulation, )
ARRAY_REFERENCE(Layers, LayerSums, )
ARRAY_REFERENCE(Escapes, Escape, )
ARRAY_REFERENCE(DemodulatedPixels, Demodulated, )
ARRAY_REFERENCE(Colours, vec3, )

#endif
