#include "runtime/nightview/device_options.h"

#include <string>

namespace nightcity::nightview {

void declare_device(CLI::App& command, gpu::Device::Options& options) {
  options.pipeline_folder = gpu::find_cache_folder();
  command.add_option("--device", options.select,
                     "Vulkan device: index or part of its name (see nightview devices)");
  command
      .add_option_function<std::string>(
          "--trace",
          [&options](const std::string& name) { options.trace = gpu::trace_from_name(name); },
          "How rays are traced: compute, through BVHs of our own on every device; query or "
          "pipeline, through the device's acceleration structures by ray queries or ray tracing "
          "pipelines")
      ->default_str(name_of(options.trace));
  command.add_flag(
      "--validation", options.validation,
      "Run under the Vulkan validation layer; any message of it makes the exit code 1");
}

}  // namespace nightcity::nightview
