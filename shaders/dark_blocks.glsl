// Blocks of pixels that showed nearly nothing in the frame before get fewer candidates.

// Pixels of such a block draw one candidate in DARK_SHARE.
const uint DARK_SHARE = 8u;
// The most that nearly nothing is, in multiples of FRAME.faint_luminance: samples that roulette
// keeps show that much.
const float DARK_RANGE = 2.0;

// Returns the index of a pixel's block.
uint block_of(uvec2 pixel) {
  const uvec2 size = FRAME.size;
  const uvec2 block = pixel / WORKGROUP_SIZE;
  return block.y * ((size.x + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE) + block.x;
}

// Returns how many candidates a pixel draws. That may depend on what the frame before showed, M may
// not: its samples would then decide the weights that they get (docs/estimator.md, condition 2).
uint candidates_of(uvec2 pixel) {
  const uint all = FRAME.candidates;
  const bool is_known = FRAME.faint_luminance > 0.0 && FRAME.has_history != 0u &&
                        FRAME.previous_size == FRAME.size;
  if (!is_known || FRAME.previous_lit_blocks.at[block_of(pixel)] != 0u) return all;
  return max(all / DARK_SHARE, 1u);
}
