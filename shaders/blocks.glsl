// Remembers what squares of WORKGROUP_SIZE^2 pixels showed in the frame before. The next frame
// samples by it: squares that showed nearly nothing get fewer candidates, and where strong lights
// were hidden, others are tested instead. Choices may depend on it, M and the weights of
// reuse may not: samples would then decide the weights that they get (docs/estimator.md, condition
// 2).

// Pixels of such a block draw one candidate in DARK_SHARE.
const uint DARK_SHARE = 8u;
// The most that nearly nothing is, in multiples of FRAME.faint_luminance: samples that roulette
// keeps show that much.
const float DARK_RANGE = 2.0;
// A test counts as many, so that a half of it counts too.
const uint ONE_TEST = 16u;

// Returns the index of a pixel's block.
uint block_of(uvec2 pixel) {
  const uvec2 size = FRAME.size;
  const uvec2 block = pixel / WORKGROUP_SIZE;
  return block.y * ((size.x + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE) + block.x;
}

// Returns whether the frame before had the same blocks.
bool knows_blocks() { return FRAME.has_history != 0u && FRAME.previous_size == FRAME.size; }

// Returns how many candidates a pixel draws.
uint candidates_of(uvec2 pixel) {
  const uint all = FRAME.candidates;
  const bool is_known = FRAME.faint_luminance > 0.0 && knows_blocks();
  if (!is_known || FRAME.previous_blocks.at[block_of(pixel)].is_lit != 0u) return all;
  return max(all / DARK_SHARE, 1u);
}

// Finds which share of the strong lights that the pixel's block tested for shadow were hidden.
// Returns false where nothing is known.
bool find_hidden_share(uvec2 pixel, out float share) {
  share = 0.0;
  if (!knows_blocks()) return false;
  const PixelBlock block = FRAME.previous_blocks.at[block_of(pixel)];
  if (block.tested == 0u) return false;
  share = float(block.hidden) / float(block.tested);
  return true;
}

// Notes that strong lights were tested for shadow at a pixel.
void note_test(uvec2 pixel, bool is_seen) {
  const uint block = block_of(pixel);
  atomicAdd(FRAME.blocks.at[block].tested, ONE_TEST);
  if (!is_seen) atomicAdd(FRAME.blocks.at[block].hidden, ONE_TEST);
}

// Begins a block's notes, with half of the tests of the frame before: where others are preferred,
// few test the strong lights, and in some frames none does.
void begin_block(uint block) {
  PixelBlock begun = PixelBlock(0u, 0u, 0u);
  if (knows_blocks()) {
    const PixelBlock before = FRAME.previous_blocks.at[block];
    begun.tested = before.tested / 2u;
    begun.hidden = before.hidden / 2u;
  }
  FRAME.blocks.at[block] = begun;
}
