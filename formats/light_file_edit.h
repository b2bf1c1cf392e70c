// Light files written anew with other contents: what a file holds, and traffic put in place of what
// it has.
#pragma once

#include <filesystem>
#include <span>

#include "formats/light_file.h"
#include "formats/light_file_writer.h"

namespace nightcity {

/// Traffic with the profiles that its vehicles' lights point into.
struct TrafficAddition {
  TrafficContent traffic;
  std::span<const LightProfile> profiles;
  std::span<const float> profile_data;
};

/// Returns all that a light file holds, for a writer. The spans point into `file`.
LightFileContent to_content(const LightFile& file);

/// Finishes a light file with `rest` and with this traffic in place of any that `rest` has. The
/// vehicles' profiles are written behind those of `rest`. Traffic without a trip leaves the file
/// without traffic. Throws Error as LightFileWriter::finish does.
void finish_with_traffic(LightFileWriter& writer, LightFileContent rest,
                         const TrafficAddition& addition);

/// Writes a light file with `content` and with this traffic in place of any that it has. The spans
/// of `content` may point into the file that is replaced. Throws Error.
void write_with_traffic(const std::filesystem::path& path, LightFileContent content,
                        const TrafficAddition& addition);

}  // namespace nightcity
