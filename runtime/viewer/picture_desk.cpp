#include "runtime/viewer/picture_desk.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <string>

#include "runtime/viewer/picture_names.h"

namespace nightcity::viewer {

void PictureDesk::begin(const View& view, double now_s) {
  if (workbench_.is_saving() || !workbench_.has_city()) {
    session_.notices.say("a picture is being saved already", now_s);
    return;
  }
  workbench_.save(view, options_.picture);
}

void PictureDesk::cancel(double now_s) {
  workbench_.stop_saving();
  session_.notices.say("the picture is not saved", now_s);
}

void PictureDesk::finish(double now_s) {
  try {
    const std::string sentence =
        save_picture(find_picture_folder(options_.picture_folder),
                     workbench_.take_saved(session_.state.settings.display));
    session_.notices.say(sentence, now_s);
    spdlog::info("{}", sentence);
  } catch (const std::exception& error) {  // a full disk is no reason to close the window
    session_.notices.say(fmt::format("the picture is not saved: {}", error.what()), now_s, true);
    spdlog::error("{}", error.what());
  }
}

}  // namespace nightcity::viewer
