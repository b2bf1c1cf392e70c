// nightview devices: lists the Vulkan devices of this machine and what each offers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "formats/program/print_json.h"
#include "runtime/gpu/device.h"
#include "runtime/nightview/commands.h"

namespace nightcity::nightview {
namespace {

std::string version_text(std::uint32_t v) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(v), VK_API_VERSION_MINOR(v),
                     VK_API_VERSION_PATCH(v));
}

void print_devices(bool as_json) {
  const auto devices = gpu::list_devices();
  if (as_json) {
    auto json = nlohmann::ordered_json::array();
    for (const gpu::DeviceInfo& d : devices)
      json.push_back({{"name", d.name},
                      {"driver", d.driver},
                      {"kind", d.kind},
                      {"vulkan", version_text(d.api_version)},
                      {"memory_bytes", d.memory_bytes},
                      {"subgroup_size", d.subgroup_size},
                      {"usable", d.usable},
                      {"missing", d.missing},
                      {"ray_query", d.ray_query},
                      {"ray_pipeline", d.ray_pipeline}});
    program::print_json(json);
    return;
  }
  if (devices.empty())
    fmt::print(
        "no Vulkan device (the Debian package mesa-vulkan-drivers has one that runs on the CPU)\n");
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const gpu::DeviceInfo& d = devices[i];
    fmt::print("{}: {} ({})\n", i, d.name, d.kind);
    fmt::print("   Vulkan {}, driver {}, {:.1f} GiB, subgroups of {}\n",
               version_text(d.api_version), d.driver, double(d.memory_bytes) / (1 << 30),
               d.subgroup_size);
    fmt::print("   {}; ray queries: {}; ray tracing pipelines: {}\n",
               d.usable ? "usable" : "not usable: lacks " + d.missing, d.ray_query ? "yes" : "no",
               d.ray_pipeline ? "yes" : "no");
  }
}

}  // namespace

void add_devices_command(CLI::App& app) {
  CLI::App* sub = app.add_subcommand("devices", "List Vulkan devices and what each offers");
  auto json = std::make_shared<bool>(false);
  sub->add_flag("--json", *json, "Print the list as JSON");
  sub->footer("Example: nightview devices --json");
  sub->callback([json] { print_devices(*json); });
}

}  // namespace nightcity::nightview
