#include "tools/osm/map_file.h"

#include <string_view>
#include <vector>

#include "formats/file_names.h"
#include "tools/city/byte_source.h"
#include "tools/city/file_stamp.h"
#include "tools/city/zip_archive.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

constexpr std::array<std::string_view, 5> entry_endings{".osm", ".pbf", ".o5m", ".osm.bz2", ".xml"};

struct UnpackedMap {
  std::string name;
  std::shared_ptr<ScratchFile> bytes;
};

// Metadata lies beside maps as XML, and so do maps themselves.
city::Document find_map(const std::filesystem::path& file) {
  constexpr std::size_t start = 1024;
  std::vector<city::Document> maps;
  for (city::Document& document : city::list_documents(file, entry_endings))
    if (!document.name.ends_with(".xml") || begins_as_osm(city::read_start(document, start)))
      maps.push_back(std::move(document));
  if (maps.empty()) throw Error(file.string(), "the archive holds XML, but no map");
  if (maps.size() == 1) return std::move(maps.front());
  throw Error(file.string(), "the archive holds " + std::to_string(maps.size()) + " maps (" +
                                 maps[0].name.substr(file.string().size() + 1) + ", " +
                                 maps[1].name.substr(file.string().size() + 1) +
                                 (maps.size() > 2 ? ", ..." : "") +
                                 "): unpack it and name those that are wanted");
}

UnpackedMap unpack_map(const std::filesystem::path& file) {
  constexpr std::size_t block = std::size_t{1} << 16;
  const city::Document document = find_map(file);
  auto bytes = std::make_shared<ScratchFile>(scratch_folder() / "map");
  const auto source = document.open_as_it_is();
  std::vector<char> some(block);
  for (std::size_t got; (got = source->read(some.data(), some.size())) > 0;)
    bytes->write(some.data(), got);
  bytes->flush();
  return {document.name, std::move(bytes)};
}

}  // namespace

MapFile::MapFile(const std::filesystem::path& file) : path_(file), name_(file.string()) {
  if (!city::is_zip(file)) return;
  static city::LastOfFiles<UnpackedMap> last;
  const UnpackedMap map = last.find(
      file, [&] { return unpack_map(file); }, [](const UnpackedMap&) { return true; });
  unpacked_ = map.bytes;
  name_ = map.name;
  path_ = unpacked_->path_while_open();
}

Error MapFile::to_named(const Error& error) const {
  const std::string path = path_.string();
  std::string text = error.what();
  if (!unpacked_) return error;
  for (std::size_t at = text.find(path); at != text.npos; at = text.find(path, at + name_.size()))
    text.replace(at, path.size(), name_);
  return Error("", text);
}

}  // namespace nightcity::osm
