// Takes each file of a list once, however often the list names it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace nightcity::inputs {

/// Says which of several mentions of a file keeps its place in the list.
enum class Mention { first, last };

struct NamedOnce {
  std::vector<std::filesystem::path> files;
  std::size_t repeats = 0;             // mentions that were taken out
  std::filesystem::path first_repeat;  // a file that was named again; empty: none was
};

/// Returns the files in their order, each once. Names are compared as text in their normal form
/// ("a/../b.gml" is "b.gml", "c/" is "c"); no file is opened, and links are not followed.
NamedOnce name_once(std::vector<std::filesystem::path> files, Mention kept = Mention::first);

}  // namespace nightcity::inputs
