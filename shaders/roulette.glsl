// Returns whether a path goes on, and weighs it for those that do not (Russian roulette; Arvo, Kirk
// 1990).
bool survives(inout vec3 throughput) {
  const float chance = min(max(throughput.r, max(throughput.g, throughput.b)), 1.0);
  if (!(random_float() < chance)) return false;
  throughput /= chance;
  return true;
}
