// Weighted reservoir sampling over (light, uv) samples.
#include "shaders/roulette.glsl"

const Reservoir EMPTY_RESERVOIR = Reservoir(NO_HIT, 0u, 0.0, 0.0);

// Returns a reservoir read from memory, emptied where M or W is not a finite, non-negative number:
// one bad value must not live on in the history.
Reservoir sanitized(Reservoir r) {
  const bool sound = r.W >= 0.0 && finite(r.W) && r.M >= 0.0 && finite(r.M);
  if (!sound) return EMPTY_RESERVOIR;
  if (r.light >= SCENE.light_count) r.W = 0.0;
  return r;
}

// Returns whether a pixel with this M has no history although there could be one: it just came into
// view. It gets more neighbours (disocclusion boost; Wyman, Panteleev 2021).
bool lacks_history(float M) {
  return FRAME.max_history > 0.0 && M <= float(FRAME.candidates);
}

// A reservoir in the making: a stream of weighted samples, resampled into one.
struct ReservoirBuilder {
  uint light;
  uint uv;
  float target;      // of the chosen sample, at the receiver
  float weight_sum;
  float M;
};

const ReservoirBuilder EMPTY_BUILDER = ReservoirBuilder(NO_HIT, 0u, 0.0, 0.0, 0.0);

// Chooses the new sample with probability weight / weight_sum, and returns whether it did. Zero,
// NaN and infinite weights never win.
bool update(inout ReservoirBuilder builder, uint light, uint uv, float p, float weight) {
  if (!(weight > 0.0) || !finite(weight)) return false;
  builder.weight_sum += weight;
  if (random_float() * builder.weight_sum >= weight) return false;
  builder.light = light;
  builder.uv = uv;
  builder.target = p;
  return true;
}

// Adds another stream of samples of the same receiver: its chosen sample, with the weight of all.
void merge(inout ReservoirBuilder builder, ReservoirBuilder other) {
  update(builder, other.light, other.uv, other.target, other.weight_sum);
}

// Returns the reservoir, W = normalisation * weight_sum / target. An empty or impossible choice has
// W = 0; a clamped divisor would instead dim whatever is fainter than the clamp.
Reservoir finalize(ReservoirBuilder builder, float normalisation) {
  Reservoir r;
  r.light = builder.light;
  r.uv = builder.uv;
  r.M = builder.M;
  const float W = builder.target > 0.0 ? normalisation * builder.weight_sum / builder.target : 0.0;
  r.W = finite(W) ? W : 0.0;
  return r;
}

// Returns the factor of a reservoir of this pixel by how much light it shows, its target times W.
// What is nearly black then costs fewer rays: a reservoir with W = 0 needs none. The factor is a
// random number whose mean is 1, so the expected value stays; M stays, because weights must not
// depend on samples.
float play_roulette(ReservoirBuilder builder, float normalisation) {
  return play_roulette(normalisation * builder.weight_sum, FRAME.faint_luminance);
}

// Does finalize() with roulette.
Reservoir finalize_with_roulette(ReservoirBuilder builder, float normalisation) {
  return finalize(builder, normalisation * play_roulette(builder, normalisation));
}
