#include "tools/osm/map_file.h"

#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/file_names.h"
#include "tools/city/archive_entries.h"
#include "tools/city/byte_source.h"
#include "tools/city/file_stamp.h"
#include "tools/city/packing.h"
#include "tools/osm/osm_json.h"
#include "tools/osm/read_osm.h"

namespace nightcity::osm {
namespace {

constexpr std::array<std::string_view, 5> entry_endings{".osm", ".pbf", ".o5m", ".xml", ".json"};

struct UnpackedMap {
  std::string name;
  std::shared_ptr<ScratchFile> bytes;
};

constexpr std::size_t start_bytes = 1024;

// Metadata lies beside maps as XML and JSON, and so do maps themselves.
city::Document find_map(const std::filesystem::path& file) {
  std::vector<city::Document> maps;
  for (city::Document& document : city::list_documents(file, entry_endings))
    if (!(document.name.ends_with(".xml") || document.name.ends_with(".json")) ||
        begins_as_osm(city::read_start(document, start_bytes)))
      maps.push_back(std::move(document));
  if (maps.empty()) throw Error(file.string(), "the archive holds XML or JSON, but no map");
  if (maps.size() == 1) return std::move(maps.front());
  throw Error(file.string(), "the archive holds " + std::to_string(maps.size()) + " maps (" +
                                 maps[0].name.substr(file.string().size() + 1) + ", " +
                                 maps[1].name.substr(file.string().size() + 1) +
                                 (maps.size() > 2 ? ", ..." : "") +
                                 "): unpack it and name those that are wanted");
}

bool is_json(const city::Document& document) {
  return begins_as_osm_json(city::read_start(document, start_bytes));
}

UnpackedMap unpack_map(const city::Document& document) {
  constexpr std::size_t block = std::size_t{1} << 16;
  auto bytes = std::make_shared<ScratchFile>(scratch_folder() / "map");
  if (is_json(document)) {
    write_as_xml(document, *bytes);
    return {document.name, std::move(bytes)};
  }
  const auto source = document.open_as_it_is();
  std::vector<char> some(block);
  for (std::size_t got; (got = source->read(some.data(), some.size())) > 0;)
    bytes->write(some.data(), got);
  bytes->flush();
  return {document.name, std::move(bytes)};
}

// Returns whether the readers of maps unpack a file themselves, or need not.
bool is_read_as_it_is(const std::filesystem::path& file) {
  switch (city::find_packing_of(file)) {
    case city::Packing::none:
    case city::Packing::gzip:
    case city::Packing::bzip2:
    case city::Packing::compress:
      return true;
    default:
      return false;
  }
}

// Returns the document of a file that is one in JSON, or in a stream that the readers of maps do
// not know.
std::optional<city::Document> find_unread(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored) ||
      std::filesystem::file_size(file, ignored) == 0)
    return std::nullopt;
  city::Document document = city::list_documents(file, entry_endings).front();
  if (!is_read_as_it_is(file)) return document;
  try {
    if (is_json(document)) return document;
  } catch (const Error&) {  // broken, as its reader says
  }
  return std::nullopt;
}

// Files by names in place of which others are read.
class StandIns {
 public:
  void set(const std::filesystem::path& file, const std::shared_ptr<ScratchFile>& bytes) {
    const std::lock_guard lock(mutex_);
    std::erase_if(bytes_, [](const auto& one) { return one.second.expired(); });
    bytes_[file] = bytes;
  }
  std::shared_ptr<ScratchFile> find(const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    const auto found = bytes_.find(file);
    return found == bytes_.end() ? nullptr : found->second.lock();
  }

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, std::weak_ptr<ScratchFile>> bytes_;
};

StandIns& stand_ins() {
  static StandIns all;
  return all;
}

}  // namespace

void set_stand_in(const std::filesystem::path& file, const std::shared_ptr<ScratchFile>& bytes) {
  stand_ins().set(file, bytes);
}

MapFile::MapFile(const std::filesystem::path& file) : path_(file), name_(file.string()) {
  if ((unpacked_ = stand_ins().find(file))) {
    path_ = unpacked_->path_while_open();
    return;
  }
  static city::LastOfFiles<UnpackedMap> last;
  std::optional<city::Document> alone;
  if (!city::is_archive_file(file) && !(alone = find_unread(file))) return;
  const UnpackedMap map = last.find(
      file, [&] { return unpack_map(alone ? *alone : find_map(file)); },
      [](const UnpackedMap& kept) { return kept.bytes->size(); });
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
