// The greatest amount of memory that the program has used so far.
#pragma once

namespace nightcity::bake {

/// Returns the maximum of resident memory so far, in MB (2^20 bytes); 0 where the system does not
/// report it.
double find_peak_memory_mb();

}  // namespace nightcity::bake
