#include "tools/terrain/sample_models.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace nightcity::terrain {
namespace {

struct WeightedMean {
  double sum = 0, weight = 0;
  bool inside = false;  // of a raster
};

}  // namespace

void sample_models(std::span<const ElevationModel> models, std::span<const glm::dvec2> places,
                   std::span<const glm::dvec2> lon_lat, std::span<double> heights) {
  std::fill(heights.begin(), heights.end(), std::numeric_limits<double>::quiet_NaN());
  std::vector<WeightedMean> means(heights.size());
  std::vector<std::size_t> open(heights.size());  // the places that have no height yet
  std::iota(open.begin(), open.end(), std::size_t{0});
  std::vector<glm::dvec2> asked;
  std::vector<HeightSample> samples;
  for (const ElevationModel& model : models) {
    if (open.empty()) return;
    asked.clear();
    for (const std::size_t i : open) asked.push_back(model.has_crs() ? lon_lat[i] : places[i]);
    samples.resize(open.size());
    model.sample_beyond(asked, samples);
    for (std::size_t k = 0; k < open.size(); ++k) {
      const HeightSample& sample = samples[k];
      if (std::isnan(sample.height)) continue;
      if (sample.weight == 1) heights[open[k]] = sample.height;
      WeightedMean& mean = means[open[k]];
      mean.sum += sample.weight * sample.height;
      mean.weight += sample.weight;
      mean.inside = mean.inside || sample.inside;
    }
    std::erase_if(open, [&](std::size_t i) { return !std::isnan(heights[i]); });
  }
  for (const std::size_t i : open)
    if (means[i].inside) heights[i] = means[i].sum / means[i].weight;
}

}  // namespace nightcity::terrain
