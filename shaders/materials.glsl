// The materials of surfaces, and the textures on them.

// Packs a reflectance into the word of a surface's material (MATERIAL_IS_COLOUR).
uint pack_colour(vec3 linear) {
  const vec3 encoded = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055,
                           greaterThan(linear, vec3(0.0031308)));  // IEC 61966-2-1
  const uvec3 steps = uvec3(clamp(encoded, 0.0, 1.0) * float(COLOUR_STEPS) + 0.5);
  return MATERIAL_IS_COLOUR | steps.r | steps.g << 10u | steps.b << 20u;
}

vec3 unpack_colour(uint colour) {
  return vec3(SCENE.linear_of_step.at[colour & 1023u],
              SCENE.linear_of_step.at[colour >> 10u & 1023u],
              SCENE.linear_of_step.at[colour >> 20u & 1023u]);
}

bool is_colour(uint material) {
  return HAS_TEXTURES != 0u && (material & MATERIAL_IS_COLOUR) != 0u;
}

// These return a surface's values by the word of its material.
vec3 base_colour_of(uint material) {
  if (is_colour(material)) return unpack_colour(material);
  return SCENE.materials.at[material].base_colour;
}

float roughness_of(uint material) {
  if (is_colour(material)) return 1.0;
  return SCENE.materials.at[material].roughness;
}

vec3 emission_of(uint material) {
  if (is_colour(material)) return vec3(0.0);
  return SCENE.materials.at[material].emission;
}

// Returns whether a surface is the pane of a window, which panes.glsl shows.
bool is_pane(uint material) {
  return !is_colour(material) && SCENE.materials.at[material].texture == PANE;
}

// Returns the texel's index along one side of `size` texels.
uint wrapped(int at, int size, uint wrap) {
  if (wrap == WRAP_CLAMP) return uint(clamp(at, 0, size - 1));
  const int period = wrap == WRAP_MIRROR ? 2 * size : size;
  int place = at % period;
  if (place < 0) place += period;
  return uint(place < size ? place : period - 1 - place);
}

// Returns what a texture reflects at its coordinates, between the four texels around them, in a
// level of it.
vec3 texture_colour(Texture picture, vec2 place, uint level) {
  uint first = picture.first;
  uvec2 size = uvec2(picture.width, picture.height);
  for (uint i = 0u; i < level; ++i) {
    first += size.x * size.y;
    size = max(size >> 1u, uvec2(1u));
  }
  // Whole repetitions are taken off, so that a float has room for the rest.
  const vec2 part = place - 2.0 * floor(0.5 * place);
  const bvec2 clamped = bvec2((picture.wrap & 3u) == WRAP_CLAMP, picture.wrap >> 2u == WRAP_CLAMP);
  const vec2 at = mix(part, clamp(place, 0.0, 1.0), clamped) * vec2(size) - 0.5;
  const ivec2 low = ivec2(floor(at));
  const vec2 share = at - vec2(low);
  vec3 sum = vec3(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    const ivec2 step = ivec2(corner & 1, corner >> 1);
    const uint x = wrapped(low.x + step.x, int(size.x), picture.wrap & 3u),
               y = wrapped(low.y + step.y, int(size.y), picture.wrap >> 2u);
    const uint texel = SCENE.texels.at[first + y * size.x + x];
    const uint stride = COLOUR_STEPS / 255u;
    const vec2 near = mix(1.0 - share, share, vec2(step));
    sum += near.x * near.y *
           vec3(SCENE.linear_of_step.at[stride * (texel & 255u)],
                SCENE.linear_of_step.at[stride * (texel >> 8u & 255u)],
                SCENE.linear_of_step.at[stride * (texel >> 16u & 255u)]);
  }
  return sum * picture.factor;
}
