// Pairs pixels for spatial reuse. A pairing is a map of the pixels that is its own inverse: where q
// is p's partner, p is q's. What has to be known for p to reuse q's sample (the target of each
// sample at the other pixel) is then just what q needs to reuse p's, and is computed once for both.
// docs/estimator.md has the equations.
//
// A pairing cuts the picture into blocks, from a corner that changes from pairing to pairing and
// from frame to frame. Two random offsets a and b of a block, flipped as bits into the coordinates
// of its pixels, make groups of four: p, p ^ a, p ^ b and p ^ a ^ b. A group has three ways to form
// two pairs, and takes the one with the most pairs of similar pixels. All this depends on
// geometry, frame, seed and pairing only, never on a sample. At half rate, all this is of the
// pixels that the frame samples, pushed together in their rows.

// Returns a random offset within FRAME.neighbour_radius, not zero, of at most `most` a coordinate.
uvec2 random_flip(uvec2 words, uint most) {
  const vec2 u = vec2(words >> 8u) * (1.0 / 16777216.0);
  const float radius = FRAME.neighbour_radius * sqrt(u.x), angle = 0.5 * PI * u.y;
  const float across = FRAME.half_rate == 0u ? 1.0 : 0.5;  // sampled pixels lie two apart in a row
  uvec2 flip = min(uvec2(round(radius * vec2(across * cos(angle), sin(angle)))), uvec2(most));
  if (flip == uvec2(0u)) flip[words.x & 1u] = 1u;
  return flip;
}

bool similar_at(uint a, uint b) {
  return a != NO_HIT && b != NO_HIT && similar(FRAME.surfaces.at[a], FRAME.surfaces.at[b]);
}

// Returns the pixel's partner in a pairing, below FRAME.pairings; NO_HIT where the pairing has no
// similar pixel for it.
uint find_partner(uvec2 pixel, uint pairing) {
  const uint stream = FRAME.seed * 16u + STREAM_PAIRING;
  const uint number = FRAME.frame * MAX_NEIGHBOURS + pairing;
  const uint last = FRAME.pair_block - 1u;
  const uvec2 corner = pcg4d(uvec4(number, stream, 0u, 1u)).xy & last;
  const uvec2 at = uvec2(FRAME.half_rate == 0u ? pixel.x : pixel.x >> 1u, pixel.y) + corner;
  const uvec4 words = pcg4d(uvec4(at & ~uvec2(last), number, stream));
  const uvec2 a = random_flip(words.xy, last), b = random_flip(words.zw, last);
  const uvec2 flips[4] = uvec2[](uvec2(0u), a, b, a ^ b);
  uint group[4];
  for (uint i = 0u; i < 4u; ++i) {
    uvec2 there = (at ^ flips[i]) - corner;  // wraps below 0, which is outside too
    if (FRAME.half_rate != 0u) there = pixel_of_colour(there.x, there.y, false);
    group[i] =
        all(lessThan(there, FRAME.size)) ? there.y * FRAME.size.x + there.x : NO_HIT;
  }
  // In the i-th way, pixels whose places differ by i are pairs.
  uint partner = NO_HIT, most = 0u;
  for (uint i = 1u; i < 4u && most < 2u; ++i) {
    const uint j = i == 1u ? 2u : 1u;  // a place that is neither 0 nor i
    if (i > 1u && a == b) break;       // the group is a pair
    const bool mine = similar_at(group[0], group[i]);
    const uint pairs = uint(mine) + uint(similar_at(group[j], group[j ^ i]));
    if (pairs <= most) continue;
    most = pairs;
    partner = mine ? group[i] : NO_HIT;
  }
  return partner;
}

// Returns whether two pixels with these M use a pairing: the boost's pairings serve a pair as soon
// as one of the two lacks a history.
bool uses_pairing(uint pairing, float M, float M_partner) {
  return pairing < FRAME.neighbours || lacks_history(M) || lacks_history(M_partner);
}

// Returns where FRAME.pair_partners holds a pixel's partner in a pairing. FRAME.pair_samples holds
// what the pixel reflects of that partner's sample one picture further.
uint pair_place(uint pairing, uint pixel) { return pairing * pixels_of_picture() + pixel; }
uint pair_sample_place(uint pairing, uint pixel) { return pair_place(pairing + 1u, pixel); }
