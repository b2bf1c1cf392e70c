// Combines a pixel's own (canonical) reservoir with others. Estimators differ in the weights:
//
//   paper     sum of M_i p^(y_i) W_i over sum of M. It counts pixels that could not have made the
//             sample, and so darkens the picture.
//   basic     1/M resampling, normalised by the balance heuristic of the chosen sample
//             (Bitterli et al. 2020, Alg. 6)
//   pairwise  each other reservoir against the canonical one, with confidence weights and a
//             defensive share for the canonical sample (after GRIS, Lin et al. 2022, sec. 7.1.3)
//   traced    pairwise, with visibility inside every target: unbiased with any shadows
//
// The pairwise weights sum to 1. With C = sum of the others' M, c = the canonical M, s_i = M_i / C:
//   m_i(y) = C/(C+c) s_i  h_i(y)
//   m_c(y) = c/(C+c) + C/(C+c) sum_i s_i (1 - h_i(y))
//   h_i(y) = C p_i(y)^2 / (C p_i(y)^2 + c p_c(y)^2)
//
// The squares make h_i a power heuristic (Veach 1997, 9.2.4) in the targets; the counts C and c
// stay as they are. GRIS has the targets p_i and p_c without squares, which treats a reservoir of M
// candidates like M samples, although it keeps only one. Example: C = 20 c, and the other pixel
// makes y ten times more rarely than this one (p_i = p_c / 10). Without squares its share is h_i =
// 2 / (2 + 1) = 2/3, so y still arrives mostly from there: seldom, and six times too bright when it
// does. With squares h_i = 0.2 / (0.2 + 1) = 1/6.

// Returns the estimator's target: with visibility where the estimator includes it. `known_visible`:
// the sample was already found to be visible from there.
float estimator_target(Receiver r, uint light, uint uv, bool known_visible) {
  const float p = target(r, light, uv);
  if (!has_shadowed_target(ESTIMATOR) || p <= 0.0 || known_visible) return p;
  return sees(r, light, uv) ? p : 0.0;
}

struct Reuse {
  ReservoirBuilder builder;
  float canonical_M;
  float canonical_target;  // of the canonical sample at its own pixel
  float canonical_share;   // running sum of s_i (1 - h_i) at the canonical sample
  float others_M;          // C, known before the first add_other
  uint chosen;             // 0 = canonical, i = the i-th other
};

Reuse begin_reuse(Receiver receiver, Reservoir canonical, float others_M) {
  Reuse reuse;
  reuse.builder = EMPTY_BUILDER;
  reuse.canonical_M = canonical.M;
  reuse.canonical_target =
      canonical.W > 0.0 ? target(receiver, canonical.light, canonical.uv) : 0.0;
  reuse.canonical_share = 0.0;
  reuse.others_M = others_M;
  reuse.chosen = 0u;
  return reuse;
}

// Returns h_i above: the other's share of a sample that both could have made; 0 where the other
// could not.
float pair_share(float p_other, float M_other, float p_canonical, float M_canonical) {
  if (!(p_other > 0.0)) return 0.0;
  // Squares of the targets alone could leave the range of floats.
  const float ratio = p_canonical / p_other;
  return 1.0 / (1.0 + M_canonical / M_other * ratio * ratio);
}

// Adds the i-th other reservoir (i from 1), of a pixel whose surface is `there`.
void add_other(inout Reuse reuse, Receiver receiver, Reservoir canonical, Reservoir other,
               Receiver there, uint i) {
  const float p = other.W > 0.0 ? estimator_target(receiver, other.light, other.uv, false) : 0.0;
  float m = other.M;  // the other weights are normalised at the end
  if (reuse_weights(ESTIMATOR) == WEIGHTS_PAIRWISE) {
    const float total = reuse.others_M + reuse.canonical_M;
    const float share = other.M / reuse.others_M;
    // The other's own sample is visible from its own pixel, or its W would be 0.
    const float p_there = p > 0.0 ? estimator_target(there, other.light, other.uv, true) : 0.0;
    m = reuse.others_M / total * share * pair_share(p_there, reuse.others_M, p, reuse.canonical_M);
    if (reuse.canonical_target > 0.0) {
      const float c_there = estimator_target(there, canonical.light, canonical.uv, false);
      reuse.canonical_share +=
          share *
          (1.0 - pair_share(c_there, reuse.others_M, reuse.canonical_target, reuse.canonical_M));
    }
  }
  if (update(reuse.builder, other.light, other.uv, p, m * p * other.W)) reuse.chosen = i;
}

// Adds the canonical sample, after the others, because its share has to be known.
void add_canonical(inout Reuse reuse, Reservoir canonical) {
  float m = canonical.M;
  if (reuse_weights(ESTIMATOR) == WEIGHTS_PAIRWISE) {
    const float total = reuse.others_M + reuse.canonical_M;
    m = (reuse.canonical_M + reuse.others_M * reuse.canonical_share) / total;
  }
  const float weight = m * reuse.canonical_target * canonical.W;
  if (update(reuse.builder, canonical.light, canonical.uv, reuse.canonical_target, weight))
    reuse.chosen = 0u;
  reuse.builder.M = reuse.canonical_M + reuse.others_M;
}

// The balance heuristic of the chosen sample, summed over the pixels that could have made it
// (WEIGHTS_BALANCE).
struct Balance {
  float source;  // the chosen sample's target at the pixel it came from
  float sum;     // of M_i p_i over all pixels
};

Balance begin_balance(Reuse reuse) {
  const float p = reuse.builder.target;
  return Balance(p, reuse.canonical_M * p);
}

// Adds the i-th other pixel, with the M that add_other was given.
void add_balance(inout Balance balance, Reuse reuse, float M, Receiver there, uint i) {
  const float p = target(there, reuse.builder.light, reuse.builder.uv);
  balance.sum += M * p;
  if (reuse.chosen == i) balance.source = p;
}

// Returns the factor of the combined reservoir's W. `balance` matters to WEIGHTS_BALANCE only.
float normalisation(Reuse reuse, Balance balance) {
  switch (reuse_weights(ESTIMATOR)) {
    case WEIGHTS_COUNTS: return 1.0 / reuse.builder.M;
    case WEIGHTS_BALANCE: return balance.sum > 0.0 ? balance.source / balance.sum : 0.0;
  }
  return 1.0;
}
