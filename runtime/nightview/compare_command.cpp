// nightview compare A.exr B.exr: the error of picture A against its reference B.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "formats/program/number_check.h"
#include "formats/program/print_json.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/false_colour.h"
#include "runtime/measure/metrics.h"
#include "runtime/nightview/commands.h"

namespace nightcity::nightview {
namespace {

struct CompareOptions {
  std::string picture, reference;
  std::optional<float> ev100;
  std::size_t worst = 0;
  bool json = false;
};

void print_as_json(const measure::Comparison& c) {
  program::print_json(
      nlohmann::ordered_json{{"rmse8", c.rmse8},
                             {"relative_mse", c.relative_mse},
                             {"relative_mse_luminance", c.relative_mse_luminance},
                             {"mean_signed_error", c.mean_signed_error},
                             {"relative_mean_signed_error", c.relative_mean_signed_error},
                             {"fireflies", c.fireflies},
                             {"mean_luminance", c.mean_luminance},
                             {"reference_mean_luminance", c.reference_mean_luminance},
                             {"ev100", c.ev100}});
}

struct WorstPixel {
  std::size_t x, y;
  double picture, reference;  // luminance, cd/m2
};

// Returns the pixels whose luminance differs most, worst first.
std::vector<WorstPixel> find_worst_pixels(const measure::Image& picture,
                                          const measure::Image& reference, std::size_t max_count) {
  const std::vector<float> a = measure::luminance_of(picture), b = measure::luminance_of(reference);
  std::vector<std::size_t> order(a.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(max_count, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
      [&](std::size_t i, std::size_t j) { return std::abs(a[i] - b[i]) > std::abs(a[j] - b[j]); });
  std::vector<WorstPixel> worst;
  for (std::size_t i = 0; i < count; ++i)
    worst.push_back({order[i] % picture.width, order[i] / picture.width, double(a[order[i]]),
                     double(b[order[i]])});
  return worst;
}

std::string describe(const measure::ImageInfo& info) {
  if (info.estimator.empty()) return "estimator not stated";  // another program made the file
  return fmt::format("{}, {} frames", info.estimator, info.frames);
}

std::string as_text(const measure::Comparison& c, const measure::Image& picture,
                    const measure::Image& reference) {
  return fmt::format(
      "picture                     {} x {}, {}\n"
      "reference                   {}\n"
      "rmse8                       {:.4f}  (8-bit values at EV100 {:.2f})\n"
      "relative_mse                {:.6g}  (of luminance: {:.6g})\n"
      "mean_signed_error           {:+.6g} cd/m2\n"
      "relative_mean_signed_error  {:+.4f} %\n"
      "fireflies                   {:.4f} % of the pixels",
      picture.width, picture.height, describe(picture.info), describe(reference.info), c.rmse8,
      c.ev100, c.relative_mse, c.relative_mse_luminance, c.mean_signed_error,
      100 * c.relative_mean_signed_error, 100 * c.fireflies);
}

void print_worst_pixels(const measure::Image& picture, const measure::Image& reference,
                        std::size_t max_count) {
  for (const WorstPixel& w : find_worst_pixels(picture, reference, max_count)) {
    fmt::print("pixel {:5} {:5}   picture {:10.4g}   reference {:10.4g} cd/m2", w.x, w.y, w.picture,
               w.reference);
    for (const measure::ImageLayer& layer : picture.layers) {
      const measure::ImageLayer* other = reference.layer(layer.name);
      if (!layer.name.starts_with("direct") || !other) continue;
      const std::size_t at = 3 * (w.y * picture.width + w.x) + 1;
      fmt::print("   {} {:.4g} {:.4g}", layer.name, layer.values[at], other->values[at]);
    }
    fmt::print("\n");
  }
}

void compare_pictures(const CompareOptions& options) {
  const measure::Image picture = measure::read_exr(options.picture),
                       reference = measure::read_exr(options.reference);
  const measure::Comparison comparison = measure::compare(picture, reference, options.ev100);
  if (options.json) {
    print_as_json(comparison);
    return;
  }
  std::puts(as_text(comparison, picture, reference).c_str());
  if (options.worst > 0) print_worst_pixels(picture, reference, options.worst);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      app.add_subcommand("compare", "Measure how far a picture is from its reference");
  command->add_option("picture", options->picture, "Picture, OpenEXR in cd/m2")->required();
  command
      ->add_option("reference", options->reference, "Reference of the same size, OpenEXR in cd/m2")
      ->required();
  command
      ->add_option("--ev", options->ev100,
                   "Exposure of both for rmse8, EV100 (default: the reference's own, else metered "
                   "from it)")
      ->check(program::number_from(-20, 40));
  command
      ->add_option("--worst", options->worst,
                   "List this many of the pixels that differ most, with the green channel of their "
                   "layers of direct light")
      ->check(program::count_from(0, 1'000'000));
  command->add_flag("--json", options->json, "Print the results as JSON");
  command->footer("Example: nightview compare night.exr truth.exr --worst 10");
  command->callback([options] { compare_pictures(*options); });
}

}  // namespace nightcity::nightview
