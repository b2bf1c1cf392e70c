// nightview compare A.exr B.exr: how far A is from its reference B.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "runtime/measure/exr.h"
#include "runtime/measure/false_colour.h"
#include "runtime/measure/metrics.h"
#include "runtime/nightview/commands.h"

namespace nightcity {
namespace {

struct CompareOptions {
  std::string picture, reference;
  std::optional<float> ev100;
  std::size_t worst = 0;
  bool json = false;
};

std::string as_json(const Comparison& c) {
  const nlohmann::ordered_json json{{"rmse8", c.rmse8},
                                    {"relative_mse", c.relative_mse},
                                    {"relative_mse_luminance", c.relative_mse_luminance},
                                    {"mean_signed_error", c.mean_signed_error},
                                    {"relative_mean_signed_error", c.relative_mean_signed_error},
                                    {"fireflies", c.fireflies},
                                    {"mean_luminance", c.mean_luminance},
                                    {"reference_mean_luminance", c.reference_mean_luminance},
                                    {"ev100", c.ev100}};
  return json.dump(2);
}

struct WorstPixel {
  std::size_t x, y;
  double picture, reference;  // luminance, cd/m2
};

// Where the two differ most, by luminance: the place to look first.
std::vector<WorstPixel> worst_pixels(const Image& picture, const Image& reference,
                                     std::size_t most) {
  const std::vector<float> a = luminance_of(picture), b = luminance_of(reference);
  std::vector<std::size_t> order(a.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(most, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
      [&](std::size_t i, std::size_t j) { return std::abs(a[i] - b[i]) > std::abs(a[j] - b[j]); });
  std::vector<WorstPixel> worst;
  for (std::size_t i = 0; i < count; ++i)
    worst.push_back({order[i] % picture.width, order[i] / picture.width, double(a[order[i]]),
                     double(b[order[i]])});
  return worst;
}

// A foreign file does not say how it was made.
std::string described(const ImageInfo& info) {
  if (info.estimator.empty()) return "estimator not stated";
  return fmt::format("{}, {} frames", info.estimator, info.frames);
}

std::string as_text(const Comparison& c, const Image& picture, const Image& reference) {
  return fmt::format(
      "picture                     {} x {}, {}\n"
      "reference                   {}\n"
      "rmse8                       {:.4f}  (8-bit values at EV100 {:.2f})\n"
      "relative_mse                {:.6g}  (of luminance: {:.6g})\n"
      "mean_signed_error           {:+.6g} cd/m2\n"
      "relative_mean_signed_error  {:+.4f} %\n"
      "fireflies                   {:.4f} % of the pixels",
      picture.width, picture.height, described(picture.info), described(reference.info), c.rmse8,
      c.ev100, c.relative_mse, c.relative_mse_luminance, c.mean_signed_error,
      100 * c.relative_mean_signed_error, 100 * c.fireflies);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "How far a picture is from its reference");
  command->add_option("picture", options->picture, "Picture, OpenEXR in cd/m2")->required();
  command
      ->add_option("reference", options->reference, "Reference of the same size, OpenEXR in cd/m2")
      ->required();
  command->add_option("--ev", options->ev100,
                      "EV100 at which both are shown for rmse8 (default: the reference's own, else "
                      "metered from it)");
  command->add_option(
      "--worst", options->worst,
      "List so many pixels that differ most, with the green of their layers of direct light");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options] {
    const Image picture = read_exr(options->picture), reference = read_exr(options->reference);
    const Comparison comparison = compare(picture, reference, options->ev100);
    std::puts(
        (options->json ? as_json(comparison) : as_text(comparison, picture, reference)).c_str());
    if (options->worst == 0 || options->json) return;
    for (const WorstPixel& w : worst_pixels(picture, reference, options->worst)) {
      fmt::print("pixel {:5} {:5}   picture {:10.4g}   reference {:10.4g} cd/m2", w.x, w.y,
                 w.picture, w.reference);
      for (const ImageLayer& layer : picture.layers) {
        const ImageLayer* other = reference.layer(layer.name);
        if (!layer.name.starts_with("direct") || !other) continue;
        const std::size_t at = 3 * (w.y * picture.width + w.x) + 1;
        fmt::print("   {} {:.4g} {:.4g}", layer.name, layer.values[at], other->values[at]);
      }
      fmt::print("\n");
    }
  });
}

}  // namespace nightcity
