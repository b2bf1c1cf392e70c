// Bounds that C++ and GLSL have to agree on: sizes of work groups, of arrays in shaders, and of one
// dispatch.
#ifndef NIGHTCITY_SHADERS_LIMITS_H
#define NIGHTCITY_SHADERS_LIMITS_H

#define WORKGROUP_SIZE 8  // a pass over pixels runs in groups of 8 x 8
#define WORKGROUP_ROW 64  // a pass over a list runs in groups of 64
#define COPIED_WORDS 8    // of 16 bytes, by an invocation of copy_memory.comp

#define MAX_NEIGHBOURS 32u  // pixels that one pixel reuses at most: the size of an array

// The reference adds up the lights in chunks, one per invocation. Mesa's CPU driver of Debian 12
// silently ends loops after 65,535 iterations summed over one invocation (measured), and a shadow
// ray takes some tens of them.
#define REFERENCE_CHUNK 128u

// A light is close to a point within CLOSE_RADII times its radius: it then fills much of the
// hemisphere. The reference samples CLOSE_POINTS points on a close light instead of one, on at most
// MAX_CLOSE_LIGHTS lights of a chunk, so that the number of iterations above stays bounded.
#define CLOSE_RADII 4.0
#define CLOSE_POINTS 4u
#define MAX_CLOSE_LIGHTS 32u

// The same for light that air scatters. Nearly every light lights some air in front of a surface,
// by a shadow ray that may cross the whole scene.
#define AIR_CHUNK 16u

// Bounces of light at most. Each takes four rays and twice BOUNCE_CANDIDATES light samples
// of one invocation's bounded number of iterations.
#define MAX_BOUNCES 16u
#define BOUNCE_CANDIDATES 8u

// If a chunk holds all lights, the reference adds up every light at each vertex of its paths, and
// follows REFERENCE_PATHS of them a pixel and frame. With more lights it resamples one of
// REFERENCE_PICK_CANDIDATES, REFERENCE_PICKS times, and follows REFERENCE_PICK_PATHS.
#define REFERENCE_PATHS 4u
#define REFERENCE_PICK_PATHS 16u
#define REFERENCE_PICKS 2u
#define REFERENCE_PICK_CANDIDATES 32u

// A cell of the irradiance cache gets this many times the paths of others in its first frame.
#define NEW_CELL_FACTOR 4u
// The round of cache_update.comp for pixels whose indirect light no cell holds.
#define UNCACHED_ROUND 0xFFFFFFFFu

#define DENOISE_LEVELS 5

#endif
