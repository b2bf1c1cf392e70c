// Runs with guard_pages.cpp loaded.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace nightcity::test {
namespace {

TEST(GuardPages, AccessBeyondABlockEndsTheProgramAndSaysWhere) {
  for (const std::size_t bytes : {16u, 4800u, 4096u, 1000000u}) {
    void* memory = nullptr;
    ASSERT_EQ(posix_memalign(&memory, 4096, bytes), 0);
    volatile char* const block = static_cast<volatile char*>(memory);
    block[0] = 1;
    block[bytes - 1] = 1;
    EXPECT_EXIT(block[bytes + 20] = 1, testing::KilledBySignal(SIGSEGV),
                "access at byte " + std::to_string(bytes + 20) + " of a block of " +
                    std::to_string(bytes) + " bytes");
    std::free(memory);
  }
}

}  // namespace
}  // namespace nightcity::test
