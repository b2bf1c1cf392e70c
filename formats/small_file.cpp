#include "formats/small_file.h"

#include "formats/error.h"
#include "formats/mapped_file.h"

namespace nightcity {

std::string read_small_file(const std::filesystem::path& path, std::size_t max_bytes) {
  const MappedFile file(path);
  if (file.bytes().size() > max_bytes)
    throw Error(path.string(), "has " + std::to_string(file.bytes().size()) +
                                   " bytes: a file of this kind has " + std::to_string(max_bytes) +
                                   " at most");
  return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

}  // namespace nightcity
