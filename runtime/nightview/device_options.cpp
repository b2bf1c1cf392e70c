#include "runtime/nightview/device_options.h"

#include <string>

namespace nightcity {

void declare_device(CLI::App& command, gpu::Device::Options& options) {
  command.add_option("--device", options.select,
                     "Vulkan device: index or part of its name (see nightview devices)");
  command
      .add_option_function<std::string>(
          "--trace", [&options](const std::string& way) { options.ray_tracing = way == "pipeline"; },
          "How rays meet the scene. compute: our own hierarchy, on every device; pipeline: the device's ray "
          "tracing")
      ->default_str("compute")
      ->check(CLI::IsMember({"compute", "pipeline"}));
  command.add_flag("--validation", options.validation,
                   "Run under the Vulkan validation layer; its messages end the run with 1");
}

}  // namespace nightcity
