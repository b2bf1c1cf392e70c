// The options of the device that a command renders on, and of how it traces rays: declared once.
#pragma once

#include <CLI/CLI.hpp>

#include "runtime/gpu/device.h"

namespace nightcity::nightview {

/// Declares --device, --trace and --validation.
void declare_device(CLI::App& command, gpu::Device::Options& options);

}  // namespace nightcity::nightview
