// nightview compare A.exr B.exr: how far A is from its reference B.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/measure/exr.h"
#include "runtime/measure/metrics.h"
#include "runtime/nightview/commands.h"

namespace nightcity {
namespace {

struct CompareOptions {
  std::string picture, reference;
  std::optional<float> ev100;
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
      picture.width, picture.height, described(picture.info), described(reference.info), c.rmse8, c.ev100,
      c.relative_mse, c.relative_mse_luminance, c.mean_signed_error, 100 * c.relative_mean_signed_error,
      100 * c.fireflies);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "How far a picture is from its reference");
  command->add_option("picture", options->picture, "Picture, OpenEXR in cd/m2")->required();
  command->add_option("reference", options->reference, "Reference of the same size, OpenEXR in cd/m2")
      ->required();
  command->add_option(
      "--ev", options->ev100,
      "EV100 at which both are shown for rmse8 (default: the reference's own, else metered from it)");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options] {
    const Image picture = read_exr(options->picture), reference = read_exr(options->reference);
    const Comparison comparison = compare(picture, reference, options->ev100);
    std::puts((options->json ? as_json(comparison) : as_text(comparison, picture, reference)).c_str());
  });
}

}  // namespace nightcity
