#include "tools/gdal/scratch_files.h"

#include <cpl_string.h>
#include <cpl_vsi_virtual.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "formats/error.h"

namespace nightcity::gdal {
namespace {

constexpr const char* prefix = "/vsinightcity/";

struct Range {
  std::shared_ptr<ScratchFile> bytes;
  std::uint64_t begin = 0, size = 0;
};

// All files that there are, by name: GDAL asks for them by nothing else.
struct Shelf {
  std::mutex mutex;
  std::map<std::string, Range, std::less<>> files;
};

Shelf& shelf() {
  static Shelf all;
  return all;
}

std::optional<Range> find(std::string_view name) {
  const std::lock_guard lock(shelf().mutex);
  const auto found = shelf().files.find(name);
  return found == shelf().files.end() ? std::nullopt : std::optional(found->second);
}

// Returns the first file in a folder or in the folders inside it.
auto find_in_folder(const std::string& folder) {
  const auto found = shelf().files.lower_bound(folder);
  return found != shelf().files.end() && found->first.starts_with(folder) ? found
                                                                          : shelf().files.end();
}

std::string to_folder(std::string_view name) {
  return std::string(name) + (name.ends_with('/') ? "" : "/");
}

class ScratchHandle : public VSIVirtualHandle {
 public:
  explicit ScratchHandle(Range range) : range_(std::move(range)) {}

  int Seek(vsi_l_offset offset, int whence) override {
    at_ = offset + (whence == SEEK_CUR ? at_ : whence == SEEK_END ? range_.size : 0);
    is_at_end_ = false;
    return 0;
  }
  vsi_l_offset Tell() override { return at_; }
  std::size_t Read(void* out, std::size_t size, std::size_t count) override {
    const std::uint64_t left = range_.size - std::min<std::uint64_t>(at_, range_.size);
    if (size == 0 || count == 0) return 0;
    is_at_end_ = count > left / size;
    const std::size_t bytes = is_at_end_ ? static_cast<std::size_t>(left) : size * count;
    try {
      range_.bytes->read(range_.begin + at_, out, bytes);
    } catch (const Error& error) {  // GDAL's C functions know no exceptions
      CPLError(CE_Failure, CPLE_FileIO, "%s", error.what());
      return 0;
    }
    at_ += bytes;
    return bytes / size;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  int Eof() override { return is_at_end_ ? 1 : 0; }
  int Close() override { return 0; }

 private:
  Range range_;
  std::uint64_t at_ = 0;
  bool is_at_end_ = false;
};

class ScratchHandler : public VSIFilesystemHandler {
 public:
  VSIVirtualHandle* Open(const char* name, const char* access, bool, CSLConstList) override {
    const auto range = find(name);
    const bool is_to_be_read = std::string_view(access).find_first_of("wa+") == std::string::npos;
    if (range && is_to_be_read) return new ScratchHandle(*range);  // GDAL owns it
    errno = range ? EACCES : ENOENT;
    return nullptr;
  }

  int Stat(const char* name, VSIStatBufL* status, int) override {
    *status = {};
    const auto range = find(name);
    if (range) {
      status->st_mode = S_IFREG;
      status->st_size = static_cast<off_t>(range->size);
      return 0;
    }
    const std::lock_guard lock(shelf().mutex);
    status->st_mode = S_IFDIR;
    const bool is_there = find_in_folder(to_folder(name)) != shelf().files.end();
    if (!is_there) errno = ENOENT;
    return is_there ? 0 : -1;
  }

  // GDAL looks at the neighbours of each file that it opens, and does without where there are more
  // than `most`: a hundred thousand files are not listed a hundred thousand times.
  char** ReadDirEx(const char* name, int most) override {
    const std::string folder = to_folder(name);
    CPLStringList names;
    const std::lock_guard lock(shelf().mutex);
    for (auto file = find_in_folder(folder);
         file != shelf().files.end() && file->first.starts_with(folder) &&
         (most <= 0 || names.Count() <= most);
         ++file)
      if (file->first.find('/', folder.size()) == std::string::npos)
        names.AddString(file->first.c_str() + folder.size());
    return names.StealList();
  }
};

}  // namespace

ScratchFiles::ScratchFiles(const std::filesystem::path& folder)
    : bytes_(std::make_shared<ScratchFile>(folder / "unpacked")) {
  static std::atomic<unsigned> count{0};
  folder_ = prefix + std::to_string(++count) + "/";
}

ScratchFiles::~ScratchFiles() {
  const std::lock_guard lock(shelf().mutex);
  std::erase_if(shelf().files, [&](const auto& file) { return file.first.starts_with(folder_); });
}

std::string ScratchFiles::add(std::string_view name, const ReadBytes& read) {
  constexpr std::size_t block = std::size_t{1} << 16;
  Range range{bytes_, bytes_->size(), 0};
  std::vector<char> bytes(block);
  for (std::size_t got; (got = read(bytes.data(), bytes.size())) > 0; range.size += got)
    bytes_->write(bytes.data(), got);
  bytes_->flush();  // from here on threads may read
  std::string path(name.substr(std::min(name.find_first_not_of("/\\"), name.size())));
  std::replace(path.begin(), path.end(), '\\', '/');
  path.insert(0, folder_);
  const std::lock_guard lock(shelf().mutex);
  shelf().files[path] = std::move(range);
  return path;
}

void install_scratch_files() {
  VSIFileManager::InstallHandler(prefix, new ScratchHandler);  // GDAL owns it
}

}  // namespace nightcity::gdal
