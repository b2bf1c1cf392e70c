// libFuzzer target: reads any bytes as an elevation model, which GDAL opens by what they are, and
// those of archives and gzip streams as packed ones.
#include <cstdint>

#include "support/abort_with.h"
#include "support/temp_folder.h"
#include "tests/tools/inputs/mutate_archive.h"
#include "tests/tools/terrain/sound_raster.h"

// Libraries ask for as much memory as a file claims to need, which costs nothing until it is written
// to. Here the system refuses it.
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=1024:allocator_may_return_null=1";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity::test;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  // libnetcdf 4.9.0 goes through a null pointer where memory is refused that a classic file claims.
  if (bytes.starts_with("CDF")) return 0;
  const TempFolder folder;  // GDAL may look at what lies beside a raster
  const auto path = folder / name_raster(bytes);
  write_text(path, bytes);
  abort_with(find_fault_of_raster(path));
  return 0;
}
