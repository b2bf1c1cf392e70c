// Which device a command renders on, and how its rays meet the scene: declared once for all commands.
#pragma once

#include <CLI/CLI.hpp>

#include "runtime/gpu/device.h"

namespace nightcity {

/// Declares --device, --trace and --validation.
void declare_device(CLI::App& command, gpu::Device::Options& options);

}  // namespace nightcity
