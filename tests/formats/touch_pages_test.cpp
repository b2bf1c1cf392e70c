#include "formats/touch_pages.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace nightcity {
namespace {

// The pages that lie in the memory as a whole are there before anything is written to them, those
// at its ends are not, and what was written stays.
TEST(TouchPages, TakesWholePagesAndKeepsWhatIsThere) {
  constexpr std::size_t page = 4096, pages = 8, bytes = pages * page;
  void* const mapped =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(mapped, MAP_FAILED);
  ASSERT_EQ(::madvise(mapped, bytes, MADV_NOHUGEPAGE), 0);
  const std::span memory(static_cast<unsigned char*>(mapped), bytes);
  memory[3 * page] = 7;
  touch_pages(memory.subspan(1, bytes - 2));
  std::vector<unsigned char> resident(pages);
  ASSERT_EQ(::mincore(mapped, bytes, resident.data()), 0);
  const auto taken = std::count_if(resident.begin(), resident.end(),
                                   [](unsigned char there) { return (there & 1) != 0; });
  if (::madvise(mapped, page, MADV_POPULATE_WRITE) == 0) {
    EXPECT_EQ(taken, std::ptrdiff_t{pages} - 2);
  }
  EXPECT_EQ(memory[3 * page], 7);
  EXPECT_EQ(std::count(memory.begin(), memory.end(), 0), std::ptrdiff_t{bytes} - 1);
  touch_pages(std::span<int>());
  ::munmap(mapped, bytes);
}

}  // namespace
}  // namespace nightcity
