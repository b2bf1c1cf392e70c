#include "runtime/nightview/device_options.h"

#include <string>

namespace nightcity {

void declare_device(CLI::App& command, gpu::Device::Options& options) {
  command.add_option("--device", options.select,
                     "Vulkan device: index or part of its name (see nightview devices)");
  using gpu::Trace;
  command
      .add_option_function<std::string>(
          "--trace",
          [&options](const std::string& name) {
            for (const Trace trace : {Trace::compute, Trace::query, Trace::pipeline})
              if (name == name_of(trace)) options.trace = trace;
          },
          "How rays meet the scene. compute: our own hierarchy, on every device; query, pipeline: the "
          "device's own, by ray queries or ray tracing pipelines")
      ->default_str(name_of(options.trace))
      ->check(CLI::IsMember({name_of(Trace::compute), name_of(Trace::query), name_of(Trace::pipeline)}));
  command.add_flag("--validation", options.validation,
                   "Run under the Vulkan validation layer; its messages end the run with 1");
}

}  // namespace nightcity
