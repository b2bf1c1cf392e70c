#include "tools/inputs/read_city.h"

#include <string>

#include "formats/error.h"
#include "tools/inputs/file_format.h"

namespace nightcity::inputs {
namespace {

const city::FileReader& find_reader(const std::filesystem::path& file) {
  const FileFormat& format = find_format(file);
  if (!format.reader)
    throw Error(file.string(), "is no city model but " + std::string(format.name));
  return *format.reader;
}

}  // namespace

city::CityHead read_city_head(const std::filesystem::path& file, const city::ReadOptions& options) {
  return find_reader(file).read_head(file, options);
}

city::ReadReport read_city(const std::filesystem::path& file, const city::ReadOptions& options,
                           const city::ObjectSink& sink) {
  return read_city_staged(file, options, city::deliver_to(sink));
}

city::ReadReport read_city_staged(const std::filesystem::path& file,
                                  const city::ReadOptions& options,
                                  const city::ObjectStage& stage) {
  return find_reader(file).read(file, options, stage);
}

std::optional<city::FileCuts> find_cuts(const std::filesystem::path& file) {
  const city::FileReader& reader = find_reader(file);
  return reader.find_cuts ? reader.find_cuts(file) : std::nullopt;
}

}  // namespace nightcity::inputs
