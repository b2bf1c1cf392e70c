// These are the views of a picture that the window shows, and the colours of a scale. C++ and GLSL
// include this file.
#ifndef NIGHTCITY_SHADERS_VIEWS_GLSL_H
#define NIGHTCITY_SHADERS_VIEWS_GLSL_H

#define VIEW_PICTURE 0u
#define VIEW_LUMINANCE 1u    // of the picture, cd/m^2
#define VIEW_ILLUMINANCE 2u  // of the surface, as if it were matt: lux
#define VIEW_DIRECT 3u       // the part of it that came straight from lights and sky
#define VIEW_INDIRECT 4u     // the part that came after a bounce at least
#define VIEW_KINDS 5u        // a colour for each kind of source, mixed by its share of the light
#define VIEW_OBJECTS 6u      // a colour for each city object
#define VIEW_HISTORY 7u      // confidence M of the pixel's reservoir, in frames' candidates
#define VIEW_NOISE 8u        // standard error of the mean over the mean, as if frames were independent
#define VIEW_WIREFRAME 9u    // the picture with the edges of all triangles
#define VIEW_TILES 10u       // a colour for each piece of an instance's triangles
#define VIEW_DIFFERENCE 11u  // of the mean from the reference's, over the reference's
#define VIEW_COUNT 12u

// Triangles that the device stores side by side, and so near each other, have one colour in
// VIEW_TILES: so many, fewer at an instance's ends.
#define TILE_TRIANGLES 256u

#define WIRE_COLOUR 90, 220, 255  // 8-bit sRGB

// The colours of a map whose lightness rises evenly from black over violet, red and orange to pale
// yellow: 8-bit sRGB.
#define FALSE_COLOUR_STOPS 9
#define FALSE_COLOURS                                                                           \
  0, 0, 4, 28, 16, 68, 79, 18, 123, 129, 37, 129, 181, 54, 122, 229, 80, 100, 251, 135, 97, 254, \
      194, 135, 252, 253, 191

// The colours of a signed scale from its lowest value over 0 to its highest: blue over grey to red,
// 8-bit sRGB (Moreland, "Diverging Color Maps for Scientific Visualization", 2009).
#define SIGNED_COLOUR_STOPS 3
#define SIGNED_COLOURS 59, 76, 192, 221, 221, 221, 180, 4, 38

// The colours of kinds of light in VIEW_KINDS: 8-bit sRGB.
#define KIND_COLOUR_LAMPS 255, 170, 60
#define KIND_COLOUR_WINDOWS 80, 150, 255
#define KIND_COLOUR_VEHICLES 255, 70, 70
#define KIND_COLOUR_SKY 70, 210, 130
#define KIND_COLOUR_INDIRECT 190, 110, 230
#define KIND_COLOUR_EMITTED 255, 255, 255

#endif
