// How much memory the program has taken so far.
#pragma once

namespace nightcity {

/// The most that has been resident at any time, in MB (2^20 bytes); 0 where the system does not tell.
double peak_memory_mb();

}  // namespace nightcity
