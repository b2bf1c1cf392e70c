// Russian roulette (Arvo, Kirk 1990): what counts for little is dropped by chance, and what stays is
// weighed for it, so that the mean stays right.
#ifndef NIGHTCITY_SHADERS_ROULETTE_GLSL
#define NIGHTCITY_SHADERS_ROULETTE_GLSL

// Returns whether a path goes on, and weighs it for those that do not.
bool survives(inout vec3 throughput) {
  const float chance = min(max(throughput.r, max(throughput.g, throughput.b)), 1.0);
  if (!(random_float() < chance)) return false;
  throughput /= chance;
  return true;
}

// Bounds the factor below: random numbers of 24 bits meet a chance of this with an error of 1e-5.
const float LEAST_CHANCE = 1.0 / 256.0;

// Returns the factor of a sample that shows `shown`: 1 from `threshold` on; below, 0 or one over
// its chance to stay, with a mean of 1. Draws from the current stream.
float play_roulette(float shown, float threshold) {
  if (!(shown < threshold)) return 1.0;
  const float chance = max(shown / threshold, LEAST_CHANCE);
  return random_float() < chance ? 1.0 / chance : 0.0;
}

#endif
