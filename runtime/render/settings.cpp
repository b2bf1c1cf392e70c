#include "runtime/render/settings.h"

#include "formats/error.h"

namespace nightcity {

const std::vector<EstimatorName>& estimator_names() {
  static const std::vector<EstimatorName> names{
      {Estimator::reference, "reference",
       "every light, every frame: the truth the others are measured against"},
      {Estimator::ris, "ris", "resampled candidates, no reuse: unbiased, noisy"},
      {Estimator::paper, "paper",
       "temporal and spatial reuse with 1/M weights, as published: biased, darker"},
      {Estimator::basic, "basic",
       "reuse with balance-heuristic normalisation of unshadowed targets: unbiased"},
      {Estimator::pairwise, "pairwise", "reuse with pairwise MIS of unshadowed targets: unbiased"},
      {Estimator::traced, "traced",
       "reuse with pairwise MIS of shadowed targets: unbiased, more shadow rays"},
  };
  return names;
}

const char* name_of(Estimator estimator) {
  for (const EstimatorName& entry : estimator_names())
    if (entry.estimator == estimator) return entry.name;
  return "unknown";
}

Estimator estimator_from_name(const std::string& name) {
  std::string known;
  for (const EstimatorName& entry : estimator_names()) {
    if (name == entry.name) return entry.estimator;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UsageError("--estimator", "no estimator '" + name + "' (there are " + known + ")");
}

const std::vector<Feature>& needless_features() {
  static const std::vector<Feature> all{{CONSTANT_PROFILES, "profiles of lamps"},
                                        {CONSTANT_RECTANGLES, "windows"},
                                        {CONSTANT_SCHEDULES, "schedules"},
                                        {CONSTANT_SKY, "sky"},
                                        {CONSTANT_GLOSS, "wet streets"}};
  return all;
}

}  // namespace nightcity
