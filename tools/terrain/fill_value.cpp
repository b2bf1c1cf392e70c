#include "tools/terrain/fill_value.h"

#include <cstdint>
#include <limits>

#include "tools/city/attributes.h"

namespace nightcity::terrain {

bool is_fill_value(double stored, double metres) {
  constexpr double lowest_land = -500;  // the shore of the Dead Sea lies at -430 m
  constexpr double lowest = -9'900, highest = 9'000;
  if (!(metres > lowest && metres < highest)) return true;
  return metres < lowest_land && city::is_sentinel(stored);
}

bool is_end_of_type(double stored, GDALDataType type) {
  switch (type) {
    case GDT_Int16:
      return stored == std::numeric_limits<std::int16_t>::min() ||
             stored == std::numeric_limits<std::int16_t>::max();
    case GDT_UInt16:
      return stored == std::numeric_limits<std::uint16_t>::max();
    case GDT_Int32:
      return stored == std::numeric_limits<std::int32_t>::min() ||
             stored == std::numeric_limits<std::int32_t>::max();
    case GDT_UInt32:
      return stored == std::numeric_limits<std::uint32_t>::max();
    default:
      return false;
  }
}

}  // namespace nightcity::terrain
