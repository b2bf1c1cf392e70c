// Sums over many frames, or over many lights.

const Accumulation NO_ACCUMULATION = Accumulation(vec3(0.0), 0.0, vec3(0.0), 0.0);

// Returns an estimate that stands alone.
Accumulation single_frame(vec3 radiance) { return Accumulation(radiance, 1.0, vec3(0.0), 0.0); }

// The weight, in frames, of light that fill.comp gave a pixel: less than that of any frame of its
// own, so that it is told from those.
const float STAND_IN = 0.5;

// Returns what sums are divided by: 1 where there is none.
float frames_of(Accumulation a) { return a.frames > 0.0 ? a.frames : 1.0; }

vec3 mean_of(Accumulation a) { return a.sum / frames_of(a); }

// Adds a value with Kahan's compensation. Without it, a late small value is lost against a large
// sum: 10^6 lights are thousands of chunks, and a picture may be the mean of thousands of frames.
void add_compensated(inout vec3 sum, inout vec3 compensation, vec3 value) {
  precise const vec3 y = value - compensation;
  precise const vec3 t = sum + y;
  precise const vec3 lost = (t - sum) - y;
  compensation = lost;
  sum = t;
}

void add_compensated(inout Accumulation total, vec3 value) {
  add_compensated(total.sum, total.compensation, value);
}
