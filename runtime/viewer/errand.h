// Errands: things that the user asked for, of which one sentence says what came.
#pragma once

#include <functional>
#include <string>

#include "runtime/viewer/notices.h"

namespace nightcity::viewer {

/// Runs an errand, and shows and logs the sentence that it returns, or shows why it failed.
void run_errand(Notices& notices, double now_s, const std::function<std::string()>& errand);

}  // namespace nightcity::viewer
