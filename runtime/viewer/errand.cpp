#include "runtime/viewer/errand.h"

#include <spdlog/spdlog.h>

#include "formats/error.h"

namespace nightcity::viewer {

void run_errand(Notices& notices, double now_s, const std::function<std::string()>& errand) {
  try {
    const std::string sentence = errand();
    if (sentence.empty()) return;
    notices.say(sentence, now_s);
    spdlog::info("{}", sentence);
  } catch (const Error& error) {
    notices.say(error.what(), now_s, true);
    spdlog::error("{}", error.what());
  }
}

}  // namespace nightcity::viewer
