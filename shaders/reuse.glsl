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

struct Reuse {
  ReservoirBuilder builder;
  float canonical_M;
  float canonical_target;  // of the canonical sample at its own pixel
  float canonical_share;   // running sum of s_i (1 - h_i) at the canonical sample
  float others_M;          // C, known before the first add_other
  uint chosen;             // 0 = canonical, i = the i-th other
};

// `canonical_target`: of the canonical sample at its own pixel.
Reuse begin_reuse(Reservoir canonical, float canonical_target, float others_M) {
  Reuse reuse;
  reuse.builder = EMPTY_BUILDER;
  reuse.canonical_M = canonical.M;
  reuse.canonical_target = canonical.W > 0.0 ? canonical_target : 0.0;
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

// The estimator's targets of a pair of pixels, the receiver ("here") and the other ("there"): all
// that pairwise weights ask of it. 0 where a reservoir is empty.
struct PairTargets {
  float other_here;
  float other_there;
  float canonical_there;
};

// Adds the i-th other reservoir (i from 1) with its pairwise weight, m_i. Returns m_i W_i, the
// weight of its sample's light.
float add_pair(inout Reuse reuse, Reservoir other, PairTargets p, uint i) {
  const float total = reuse.others_M + reuse.canonical_M;
  const float share = other.M / reuse.others_M;
  const float m =
      reuse.others_M / total * share *
      pair_share(p.other_there, reuse.others_M, p.other_here, reuse.canonical_M);
  if (reuse.canonical_target > 0.0)
    reuse.canonical_share += share * (1.0 - pair_share(p.canonical_there, reuse.others_M,
                                                       reuse.canonical_target, reuse.canonical_M));
  const float weight = m * other.W;
  if (update(reuse.builder, other.light, other.uv, p.other_here, weight * p.other_here))
    reuse.chosen = i;
  return weight;
}

// Adds the i-th other reservoir (i from 1), of a pixel whose surface is `there`.
void add_other(inout Reuse reuse, Receiver receiver, Reservoir canonical, Reservoir other,
               Receiver there, uint i) {
  PairTargets p;
  p.other_here = other.W > 0.0 ? estimator_target(receiver, other.light, other.uv) : 0.0;
  if (reuse_weights(ESTIMATOR) != WEIGHTS_PAIRWISE) {
    // The other weights are normalised at the end.
    if (update(reuse.builder, other.light, other.uv, p.other_here,
               other.M * p.other_here * other.W))
      reuse.chosen = i;
    return;
  }
  // The other's own sample is visible from its own pixel, or its W would be 0.
  p.other_there = p.other_here > 0.0 ? target(there, other.light, other.uv) : 0.0;
  p.canonical_there = reuse.canonical_target > 0.0
                          ? estimator_target(there, canonical.light, canonical.uv)
                          : 0.0;
  add_pair(reuse, other, p, i);
}

// Adds the canonical sample, after the others, because its share has to be known. Returns its m W.
float add_canonical(inout Reuse reuse, Reservoir canonical) {
  float m = canonical.M;
  if (reuse_weights(ESTIMATOR) == WEIGHTS_PAIRWISE) {
    const float total = reuse.others_M + reuse.canonical_M;
    m = (reuse.canonical_M + reuse.others_M * reuse.canonical_share) / total;
  }
  const float weight = m * canonical.W;
  if (update(reuse.builder, canonical.light, canonical.uv, reuse.canonical_target,
             weight * reuse.canonical_target))
    reuse.chosen = 0u;
  reuse.builder.M = reuse.canonical_M + reuse.others_M;
  return weight;
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
