// The estimators: their numbers, and what each of them does. Both C++ and GLSL include this file,
// so that a trait is written once: the passes ask it of the specialization constant ESTIMATOR, the
// renderer of its settings. To add an estimator, give it a number and a case in each function
// below; its name stands in runtime/render/settings.cpp.
#ifndef NIGHTCITY_SHADERS_ESTIMATORS_GLSL_H
#define NIGHTCITY_SHADERS_ESTIMATORS_GLSL_H

#ifdef __cplusplus
#include <cstdint>
namespace nightcity::gpu {
using uint = std::uint32_t;
#define TRAIT constexpr
#else
#define TRAIT
#endif

// In the order from the paper's weights to unbiased ones (docs/architecture.md).
#define ESTIMATOR_REFERENCE 0u  // every light, no sampling of lights
#define ESTIMATOR_RIS 1u        // candidates only, no reuse
#define ESTIMATOR_PAPER 2u      // reuse with 1/M weights, as published: biased, darker
#define ESTIMATOR_BASIC 3u      // reuse, balance-heuristic normalisation of unshadowed targets
#define ESTIMATOR_PAIRWISE 4u   // reuse, pairwise MIS of unshadowed targets
#define ESTIMATOR_TRACED 5u     // reuse, pairwise MIS of shadowed targets: unbiased
#define ESTIMATOR_COUNT 6

// Ways of weighing the reservoirs that are combined: reuse.glsl.
#define WEIGHTS_NONE 0u      // nothing is combined
#define WEIGHTS_COUNTS 1u    // M_i, normalised by the sum of M
#define WEIGHTS_BALANCE 2u   // M_i, normalised by the balance heuristic of the chosen sample
#define WEIGHTS_PAIRWISE 3u  // pairwise MIS: the weights sum to 1 by themselves

/// Returns which weights combine a pixel's reservoir with others.
TRAIT uint reuse_weights(uint estimator) {
  return estimator == ESTIMATOR_PAPER                                       ? WEIGHTS_COUNTS
         : estimator == ESTIMATOR_BASIC                                     ? WEIGHTS_BALANCE
         : estimator == ESTIMATOR_PAIRWISE || estimator == ESTIMATOR_TRACED ? WEIGHTS_PAIRWISE
                                                                            : WEIGHTS_NONE;
}

/// Returns whether it resamples candidates, instead of adding up every light.
TRAIT bool samples_lights(uint estimator) {
  return estimator != ESTIMATOR_REFERENCE;
}

/// Returns whether it reuses reservoirs: those of the frame before (temporal.comp) and of other
/// pixels (spatial.comp).
TRAIT bool reuses_reservoirs(uint estimator) {
  return reuse_weights(estimator) != WEIGHTS_NONE;
}

/// Returns whether its target function includes visibility. A sample it keeps is then known to be
/// visible.
TRAIT bool has_shadowed_target(uint estimator) {
  return estimator == ESTIMATOR_TRACED;
}

/// Returns whether candidates in shadow are always dropped before reuse; the others do so on
/// request (VISIBILITY_REUSE).
TRAIT bool drops_shadowed_candidates(uint estimator) {
  return estimator == ESTIMATOR_PAPER || has_shadowed_target(estimator);
}

/// Returns whether it runs with the settings of its publication: candidates uniform over all
/// lights, the history in full, no disocclusion boost and no permutation.
TRAIT bool has_published_settings(uint estimator) {
  return estimator == ESTIMATOR_PAPER;
}

#ifdef __cplusplus
}  // namespace nightcity::gpu
#endif
#undef TRAIT

#endif
