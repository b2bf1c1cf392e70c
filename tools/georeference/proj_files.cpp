#include "tools/georeference/proj_files.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <vector>

namespace nightcity::georeference {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> list_own_folders() {
  std::vector<fs::path> folders;
  std::istringstream names(proj_info().searchpath);
  for (std::string name; std::getline(names, name, ':');) {
    std::error_code error;
    const fs::path folder = fs::canonical(name, error);
    if (!error) folders.push_back(folder);
  }
  return folders;
}

bool is_own_file(const char* name) {
  static const std::vector<fs::path> folders = list_own_folders();
  std::error_code error;
  const fs::path file = fs::canonical(name, error);
  if (error || !fs::is_regular_file(file, error)) return false;
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
           folder.end();
  });
}

std::FILE* to_file(PROJ_FILE_HANDLE* handle) {
  return reinterpret_cast<std::FILE*>(handle);
}

PROJ_FILE_HANDLE* open_file(PJ_CONTEXT*, const char* name, PROJ_OPEN_ACCESS access, void* refused) {
  if (access != PROJ_OPEN_ACCESS_READ_ONLY) return nullptr;
  if (is_own_file(name)) return reinterpret_cast<PROJ_FILE_HANDLE*>(std::fopen(name, "rbe"));
  // PROJ also looks for what its folders lack where nothing is.
  std::error_code error;
  if (fs::exists(name, error)) *static_cast<std::string*>(refused) = name;
  return nullptr;
}

std::size_t read_file(PJ_CONTEXT*, PROJ_FILE_HANDLE* handle, void* bytes, std::size_t size, void*) {
  return std::fread(bytes, 1, size, to_file(handle));
}
std::size_t write_file(PJ_CONTEXT*, PROJ_FILE_HANDLE*, const void*, std::size_t, void*) {
  return 0;
}
int seek_file(PJ_CONTEXT*, PROJ_FILE_HANDLE* handle, long long offset, int whence, void*) {
  return ::fseeko(to_file(handle), offset, whence) == 0;
}
unsigned long long tell_file(PJ_CONTEXT*, PROJ_FILE_HANDLE* handle, void*) {
  return static_cast<unsigned long long>(::ftello(to_file(handle)));
}
void close_file(PJ_CONTEXT*, PROJ_FILE_HANDLE* handle, void*) {
  std::fclose(to_file(handle));
}
int is_there(PJ_CONTEXT*, const char* name, void*) {
  return is_own_file(name);
}
int refuse_name(PJ_CONTEXT*, const char*, void*) {
  return 0;
}
int refuse_names(PJ_CONTEXT*, const char*, const char*, void*) {
  return 0;
}

}  // namespace

void keep_to_own_files(PJ_CONTEXT* context, std::string& refused) {
  static const PROJ_FILE_API api{1,           open_file,   read_file,   write_file,
                                 seek_file,   tell_file,   close_file,  is_there,
                                 refuse_name, refuse_name, refuse_names};
  proj_context_set_fileapi(context, &api, &refused);
}

}  // namespace nightcity::georeference
