// An OBJ, its library of colours and a picture in one file, as the corpus and the fuzzer have them.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "support/temp_folder.h"

namespace nightcity::test {

/// Ends the OBJ, and then the library; the picture is the rest.
constexpr std::string_view bundle_mark = "%%%%\n";

/// Writes a bundle's files into a folder and returns the OBJ's path. The other two have the names
/// "m.mtl" and "p.png", whatever the picture is; a part without bytes is an empty file.
inline std::filesystem::path write_bundle(const TempFolder& folder, std::string_view bundle) {
  std::array<std::string_view, 3> parts;
  for (std::string_view& part : parts) {
    const std::size_t end =
        &part == &parts.back() ? bundle.size() : std::min(bundle.find(bundle_mark), bundle.size());
    part = bundle.substr(0, end);
    bundle.remove_prefix(std::min(end + bundle_mark.size(), bundle.size()));
  }
  write_text(folder / "a.obj", parts[0]);
  write_text(folder / "m.mtl", parts[1]);
  write_text(folder / "p.png", parts[2]);
  return folder / "a.obj";
}

}  // namespace nightcity::test
