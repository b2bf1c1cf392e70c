// Combining a pixel's own (canonical) reservoir with others': the weights are the estimator.
//
//   paper     sum of M_i p^(y_i) W_i over sum of M: counts pixels that could not have made the sample, hence darkens
//   basic     1/M resampling, normalised by the balance heuristic of the chosen sample (Bitterli et al. 2020, Alg. 6)
//   pairwise  each other reservoir against the canonical one, with confidence weights and a defensive share for the
//             canonical sample (after GRIS, Lin et al. 2022, sec. 7.1.3)
//   traced    pairwise, with visibility inside every target: unbiased whatever the shadows
//
// Partition of unity of the pairwise weights, C = sum of the others' M, c = the canonical M, s_i = M_i / C:
//   m_i(y) = C/(C+c) s_i  h_i(y)
//   m_c(y) = c/(C+c) + C/(C+c) sum_i s_i (1 - h_i(y))
//   h_i(y) = C p_i(y)^2 / (C p_i(y)^2 + c p_c(y)^2)
// The squares are a power heuristic (Veach 1997, 9.2.4) in the targets, not in the counts. GRIS has p_i and p_c themselves,
// as if a reservoir of M candidates were M samples. It is one: where the other pixel makes y ten times more rarely, that form
// with C = 20 c still leaves it two thirds of the pair, and y arrives seldom and six times too bright.

const bool PAIRWISE = ESTIMATOR == ESTIMATOR_PAIRWISE || ESTIMATOR == ESTIMATOR_TRACED;

// Target with visibility where the estimator has it. `known_visible`: the sample was already seen from there.
float estimator_target(Receiver r, uint light, uint uv, bool known_visible) {
  const float p = target(r, light, uv);
  if (ESTIMATOR != ESTIMATOR_TRACED || p <= 0.0 || known_visible) return p;
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
  reuse.canonical_target = canonical.W > 0.0 ? target(receiver, canonical.light, canonical.uv) : 0.0;
  reuse.canonical_share = 0.0;
  reuse.others_M = others_M;
  reuse.chosen = 0u;
  return reuse;
}

// h_i above: the other's part of a sample that both could have made. 0 where it could not.
float pair_share(float p_other, float M_other, float p_canonical, float M_canonical) {
  if (!(p_other > 0.0)) return 0.0;
  const float ratio = p_canonical / p_other;  // squares of targets alone could leave the range of floats
  return 1.0 / (1.0 + M_canonical / M_other * ratio * ratio);
}

// The i-th other reservoir (i from 1), of a pixel whose surface is `there`.
void add_other(inout Reuse reuse, Receiver receiver, Reservoir canonical, Reservoir other, Receiver there, uint i) {
  const float p = other.W > 0.0 ? estimator_target(receiver, other.light, other.uv, false) : 0.0;
  float m = other.M;  // paper, basic: normalised at the end
  if (PAIRWISE) {
    const float total = reuse.others_M + reuse.canonical_M;
    const float share = other.M / reuse.others_M;
    // The other's own sample was seen from its own pixel, or its W would be 0.
    const float p_there = p > 0.0 ? estimator_target(there, other.light, other.uv, true) : 0.0;
    m = reuse.others_M / total * share * pair_share(p_there, reuse.others_M, p, reuse.canonical_M);
    if (reuse.canonical_target > 0.0) {
      const float c_there = estimator_target(there, canonical.light, canonical.uv, false);
      reuse.canonical_share +=
          share * (1.0 - pair_share(c_there, reuse.others_M, reuse.canonical_target, reuse.canonical_M));
    }
  }
  if (update(reuse.builder, other.light, other.uv, p, m * p * other.W)) reuse.chosen = i;
}

// Adds the canonical sample last, when its share is known.
void add_canonical(inout Reuse reuse, Reservoir canonical) {
  float m = canonical.M;
  if (PAIRWISE) {
    const float total = reuse.others_M + reuse.canonical_M;
    m = (reuse.canonical_M + reuse.others_M * reuse.canonical_share) / total;
  }
  const float weight = m * reuse.canonical_target * canonical.W;
  if (update(reuse.builder, canonical.light, canonical.uv, reuse.canonical_target, weight)) reuse.chosen = 0u;
  reuse.builder.M = reuse.canonical_M + reuse.others_M;
}
