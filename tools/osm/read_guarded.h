// Errors of libraries that read maps, with the map's name.
#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "formats/error.h"

namespace nightcity::osm {

/// Returns what `work` returns. Throws Error with the file's name where it throws anything.
template <class Work>
auto read_guarded(const std::filesystem::path& file, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(file.string(), std::string("broken map: ") + error.what());
  }
}

}  // namespace nightcity::osm
