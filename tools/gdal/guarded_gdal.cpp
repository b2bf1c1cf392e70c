#include "tools/gdal/guarded_gdal.h"

#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_vsi_virtual.h>
#include <gdal_priv.h>

#include <cerrno>
#include <mutex>

#include "tools/gdal/scratch_files.h"

namespace nightcity::gdal {
namespace {

class NoNetwork : public VSIFilesystemHandler {
 public:
  VSIVirtualHandle* Open(const char*, const char*, bool, CSLConstList) override { return refuse(); }
  int Stat(const char*, VSIStatBufL*, int) override {
    refuse();
    return -1;
  }

 private:
  static VSIVirtualHandle* refuse() {
    errno = EACCES;
    return nullptr;
  }
};

void register_all() {
  GDALAllRegister();
  for (const char* name : {"curl", "s3", "gs", "az", "adls", "oss", "swift"}) {
    const std::string prefix = std::string("/vsi") + name;
    VSIFileManager::InstallHandler(prefix + "/", new NoNetwork);  // GDAL owns it
    VSIFileManager::InstallHandler(prefix + "_streaming/", new NoNetwork);
  }
  for (const char* prefix : {"/vsicurl?", "/vsiwebhdfs/", "/vsihdfs/"})
    VSIFileManager::InstallHandler(prefix, new NoNetwork);
  install_scratch_files();
}

CPLHTTPResult* refuse_fetch(const char*, CSLConstList, GDALProgressFunc, void*,
                            CPLHTTPFetchWriteFunc, void*, void*) {
  auto* result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup("the network is not used");
  return result;  // GDAL frees it; null would let it fetch after all
}

}  // namespace

void register_drivers() {
  static std::once_flag registered;
  std::call_once(registered, register_all);
}

Guard::Guard() {
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLHTTPPushFetchCallback(refuse_fetch, nullptr);
}

Guard::~Guard() {
  CPLHTTPPopFetchCallback();
  CPLPopErrorHandler();
}

std::string find_reason() {
  const std::string message = CPLGetLastErrorMsg();
  return message.empty() ? "GDAL gives no reason" : message;
}

}  // namespace nightcity::gdal
