// One part of a bake: the objects of a share of the inputs, read and made ready, in a file of their
// own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "tools/bake/bake_options.h"
#include "tools/bake/parts/share.h"
#include "tools/bake/progress.h"

namespace nightcity::bake {

struct BakedPart {
  std::filesystem::path file;
  bool was_done = false;  // by an earlier run, from the same recipe and inputs
  std::uint64_t objects = 0, bytes = 0;
};

/// Leaves DIR/parts/part-3-of-64 in `folder`, which is made where it is absent, or throws Error and
/// leaves no such file. A part that is there already, of the same recipe and inputs, is kept. What
/// all parts have to know of the inputs is in DIR/parts/survey: the first part makes it. Memory
/// grows with the number of input files and with the map's buildings, with nothing else.
/// `version`: of the program.
BakedPart bake_part(const BakeOptions& options, const Share& share,
                    const std::filesystem::path& folder, const std::string& version,
                    const ProgressSink& progress = {});

/// The folder of parts inside an output folder, and the name of a part in it.
constexpr const char* parts_folder = "parts";
std::string name_part(const Share& share);

}  // namespace nightcity::bake
