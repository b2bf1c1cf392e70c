// Measures how fast a device moves memory: the bound of every pass that only reads and writes.
#pragma once

#include "runtime/gpu/device.h"

namespace nightcity::render {

/// Returns the bytes a second that shaders read and write, together, in copying one large
/// buffer to another: the median of some copies, by the device's clock. 0 on queues without
/// timestamps. Throws Error if there is not enough memory.
double measure_copy_speed(gpu::Device& device);

}  // namespace nightcity::render
