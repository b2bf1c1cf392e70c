// Random numbers: one stream per pixel, frame and pass. Hash: pcg4d (Jarzynski, Olano: Hash
// Functions for GPU Rendering, JCGT 2020); stream: PCG RXS-M-XS (O'Neill 2014).

// One tag per pass, so that no two passes draw the same numbers.
const uint STREAM_CANDIDATES = 1u;
const uint STREAM_TEMPORAL = 2u;
const uint STREAM_SPATIAL = 3u;
const uint STREAM_REFERENCE = 4u;
const uint STREAM_SKY = 5u;
const uint STREAM_PAIRING = 6u;
const uint STREAM_PATH = 7u;
const uint STREAM_INDIRECT = 8u;
const uint STREAM_AIR = 9u;
const uint STREAM_AIR_BLOCK = 10u;  // of a block of pixels, the same in every frame
const uint STREAM_UPWARD = 77u;  // of a light, not of a pixel

uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  v ^= v >> 16u;
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  return v;
}

uint random_state;

void seed_random(uvec2 pixel, uint stream) {
  random_state = pcg4d(uvec4(pixel, FRAME.frame, FRAME.seed * 16u + stream)).w;
}

// Seeds the stream of a light, in a pass over lights.
void seed_random_of_light(uint light, uint stream) {
  random_state = pcg4d(uvec4(light, FRAME.frame, stream, FRAME.seed)).w;
}

uint random_uint() {
  random_state = random_state * 747796405u + 2891336453u;
  const uint word = ((random_state >> ((random_state >> 28u) + 4u)) ^ random_state) * 277803737u;
  return (word >> 22u) ^ word;
}

// Returns a number in [0, 1): 24 bits, so that rounding never reaches 1.
float random_float() { return float(random_uint() >> 8u) * (1.0 / 16777216.0); }

// The largest float below 1: sums of random numbers may round up to 1.
const float BELOW_ONE = 0.99999994;

// Maps a random word to [0, n), n > 0, in n ranges of words whose lengths differ by at most one. A
// float has 24 bits: with a million lights, some would be picked 5 % too seldom.
uint scale_word(uint word, uint n) {
  uint high, low;
  umulExtended(word, n, high, low);
  return high;
}

// Returns a uniform whole number in [0, n), n > 0; never n.
uint random_below(uint n) { return scale_word(random_uint(), n); }

// Returns point `index` of the R2 sequence (Roberts 2018), in [0, 1)^2, from a random start. Its
// points are spread evenly over the square however many of them are taken.
vec2 r2_point(uvec2 start, uint index) {
  const uvec2 at = start + index * uvec2(3242174889u, 2447445414u);
  return vec2(at >> 8u) * (1.0 / 16777216.0);
}
