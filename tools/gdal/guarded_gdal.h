// Every use of GDAL here takes its drivers from a list, is silent and has no network.
#pragma once

#include <string>

namespace nightcity::gdal {

/// Registers GDAL's drivers once, lets it find unpacked files (scratch_files.h), and puts refusals
/// in the place of the file systems by which GDAL reads from the network: overviews and masks can
/// be named there too.
void register_drivers();

/// Keeps GDAL from printing its errors, since ours carry its last message, and this thread's GDAL
/// from fetching anything from the network: a GeoJSON may name its CRS by an address.
class Guard {
 public:
  Guard();
  ~Guard();
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;
};

/// Returns GDAL's last message, or that it gives none.
std::string find_reason();

}  // namespace nightcity::gdal
