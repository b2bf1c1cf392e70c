#include "runtime/render/record_traffic.h"

#include "runtime/render/frame_values.h"
#include "shaders/frame.h"
#include "shaders/limits.h"

namespace nightcity::render {
namespace {

constexpr std::size_t surface = sizeof(gpu::Surface), reservoir = sizeof(gpu::Reservoir),
                      mean = sizeof(gpu::Accumulation), filtered = sizeof(gpu::Demodulated),
                      word = sizeof(std::uint32_t);

void add_sampling(std::map<std::string, std::size_t>& bytes, const RenderSettings& settings) {
  bytes["candidates"] = surface + reservoir;
  const EstimatorTraits& traits = traits_of(settings.sampling.estimator);
  if (traits.reuses && settings.reuse.max_history > 0)
    bytes["temporal"] = 2 * surface + 3 * reservoir;
  const std::size_t neighbours = traits.reuses ? settings.reuse.neighbours : 0;
  const bool in_pairs = neighbours > 0 && traits.pairs && traits.shadowed_target;
  if (neighbours == 0) {
    bytes["copy"] = 2 * reservoir;
  } else if (traits.pairs) {
    // A partner for each pairing, used or not; what each partner's sample and the own one give.
    const std::size_t pairs =
        pairings_of(settings.reuse) * word + (neighbours + 1) * sizeof(gpu::ReflectedSample);
    bytes["spatial targets"] = surface + reservoir + pairs;
    bytes["spatial"] = pairs + 2 * reservoir + (in_pairs ? mean : 0);
  } else {
    bytes["spatial"] = surface + 2 * reservoir;
  }
  bytes["shade"] = surface + (in_pairs ? mean : reservoir) + mean;
  if (settings.sampling.layers) bytes["shade"] += 2 * sizeof(gpu::LayerSums);
}

void add_means(std::map<std::string, std::size_t>& bytes, const RenderSettings& settings) {
  bytes["accumulate"] = 2 * mean + word;
  if (settings.averaging.accumulate) bytes["accumulate"] += mean;
  if (settings.averaging.accumulate && settings.averaging.window > 0)
    bytes["accumulate"] += 2 * surface;
  if (!settings.display.denoise) return;
  bytes["demodulate"] = surface + mean + filtered;
  const std::size_t last = 2 * mean + word, copy = 2 * mean;
  bytes["denoise"] = DENOISE_LEVELS * (surface + 2 * filtered) + last + copy;
}

}  // namespace

std::map<std::string, std::size_t> find_record_bytes(const RenderSettings& settings) {
  std::map<std::string, std::size_t> bytes;
  if (is_half_rate(settings)) return bytes;
  bytes["primary"] = surface + (settings.sampling.hits ? 2 * word : 0);
  if (traits_of(settings.sampling.estimator).samples) add_sampling(bytes, settings);
  add_means(bytes, settings);
  return bytes;
}

}  // namespace nightcity::render
