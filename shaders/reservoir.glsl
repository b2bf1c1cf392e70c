// Weighted reservoir sampling over (light, uv) samples.

const Reservoir EMPTY_RESERVOIR = Reservoir(NO_HIT, 0u, 0.0, 0.0);

// A reservoir from memory: anything that is not a finite, non-negative weight is emptied, so that one bad value
// cannot live on in the history.
Reservoir sanitized(Reservoir r) {
  const bool sound = r.W >= 0.0 && finite(r.W) && r.M >= 0.0 && finite(r.M);
  if (!sound) return EMPTY_RESERVOIR;
  if (r.light >= SCENE.light_count) r.W = 0.0;
  return r;
}

// A stream of weighted samples being resampled into one.
struct ReservoirBuilder {
  uint light;
  uint uv;
  float target;      // of the chosen sample, at the receiver
  float weight_sum;
  float M;
};

const ReservoirBuilder EMPTY_BUILDER = ReservoirBuilder(NO_HIT, 0u, 0.0, 0.0, 0.0);

// Chooses the new sample with probability weight / weight_sum. Zero, NaN and infinite weights never win.
bool update(inout ReservoirBuilder s, uint light, uint uv, float p, float weight) {
  if (!(weight > 0.0) || !finite(weight)) return false;
  s.weight_sum += weight;
  if (random_float() * s.weight_sum >= weight) return false;
  s.light = light;
  s.uv = uv;
  s.target = p;
  return true;
}

// W = normalisation * weight_sum / target; an empty or impossible choice has W = 0, never a clamped divisor.
Reservoir finalize(ReservoirBuilder s, float normalisation) {
  Reservoir r;
  r.light = s.light;
  r.uv = s.uv;
  r.M = s.M;
  const float W = s.target > 0.0 ? normalisation * s.weight_sum / s.target : 0.0;
  r.W = finite(W) ? W : 0.0;
  return r;
}
