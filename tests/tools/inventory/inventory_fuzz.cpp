// libFuzzer target: reads any bytes as a table of lamps under a name that their beginning chooses,
// and each line as the text of a cell.
#include <algorithm>
#include <cstdint>

#include "support/abort_with.h"
#include "support/temp_folder.h"
#include "tests/tools/inputs/mutate_archive.h"
#include "tests/tools/inventory/sound_inventory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity::test;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  static const TempFolder folder;
  const auto path = folder / name_table(text);
  write_text(path, text);
  abort_with(find_fault_of_inventory(path));
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    abort_with(find_fault_of_cell(line));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return 0;
}
