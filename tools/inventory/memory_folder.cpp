#include "tools/inventory/memory_folder.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "formats/error.h"

namespace nightcity::inventory {

MemoryFolder::MemoryFolder() {
  static std::atomic<unsigned> count{0};
  folder_ = "/vsimem/nightcity_tables_" + std::to_string(++count) + "/";
}

MemoryFolder::~MemoryFolder() {
  for (const std::string& path : paths_) VSIUnlink(path.c_str());
}

MemoryFolder::MemoryFolder(MemoryFolder&& other) noexcept
    : folder_(std::move(other.folder_)), paths_(std::exchange(other.paths_, {})) {}

MemoryFolder& MemoryFolder::operator=(MemoryFolder&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(paths_, other.paths_);
  return *this;
}

std::string MemoryFolder::add(std::string_view name, std::string_view bytes) {
  const std::size_t folders = name.find_last_of("/\\");
  const std::string_view simple = folders == name.npos ? name : name.substr(folders + 1);
  const std::string path = folder_ + std::string(simple);
  auto* copy = static_cast<GByte*>(VSIMalloc(bytes.size() + 1));
  if (!copy) throw Error(std::string(name), "there is no memory for it");
  std::copy(bytes.begin(), bytes.end(), copy);
  VSILFILE* file = VSIFileFromMemBuffer(path.c_str(), copy, bytes.size(), TRUE);
  if (!file) throw Error(std::string(name), "there is no memory for it");
  VSIFCloseL(file);
  paths_.push_back(path);
  return path;
}

}  // namespace nightcity::inventory
