// Specialization constants: what the scene contains and what the user asked for, known before a
// shader is compiled.
#ifndef NIGHTCITY_SHADERS_SPECIALIZATION_H
#define NIGHTCITY_SHADERS_SPECIALIZATION_H

#define CONSTANT_ESTIMATOR 0         // ESTIMATOR_*
#define CONSTANT_PROFILES 1          // some lamp has a luminaire profile
#define CONSTANT_RECTANGLES 2        // some light is a window
#define CONSTANT_VISIBILITY_REUSE 3  // candidates in shadow are dropped before reuse
#define CONSTANT_SKY 4               // SKY_*
#define CONSTANT_SCHEDULES 5         // some light is not always on
#define CONSTANT_TRAFFIC 6           // the scene has vehicles
#define CONSTANT_GLOSS 7             // surfaces that face up are wet
#define CONSTANT_LAYERS 8            // the light of each kind of source is kept apart
#define CONSTANT_COUNT_RAYS 9        // the frame's shadow rays are counted
#define CONSTANT_INDIRECT 10         // INDIRECT_*
#define CONSTANT_AIR 11              // AIR_*
#define CONSTANT_PROJECTION 12       // PROJECTION_*
#define CONSTANT_TEXTURES 13         // pictures lie on some surfaces
// The display alone has these (runtime/render/display.h).
#define CONSTANT_GLARE 14    // the eye scatters light
#define CONSTANT_WHITE 15    // the eye or the camera is adapted to a white
#define CONSTANT_MESOPIC 16  // rods see in dim places
#define CONSTANT_COUNT 17

// Values of CONSTANT_INDIRECT: how light that bounced is found.
#define INDIRECT_NONE 0u   // it is left out
#define INDIRECT_PATHS 1u  // by a path of each pixel: unbiased
#define INDIRECT_CACHE 2u  // from the irradiance cache: smoothed

// Values of CONSTANT_AIR.
#define AIR_CLEAR 0u    // it takes no light
#define AIR_EVEN 1u     // the same at all heights
#define AIR_LAYERED 2u  // denser below

// Values of CONSTANT_SKY.
#define SKY_DARK 0u     // neither sky nor moon gives light
#define SKY_UNIFORM 1u  // one luminance everywhere; zero where only the moon shines
#define SKY_MAP 2u      // a luminance by direction

#endif
