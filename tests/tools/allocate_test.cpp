// Programs that nightcity_allocate_fast() gives another allocator end as others do where there is
// no memory: by an exception, which run_program() turns into a message and an exit code.
#include <gtest/gtest.h>

#include <cstddef>
#include <new>

namespace nightcity {
namespace {

// More than any machine can address. Compilers may leave out a new-expression that is not used;
// they may not leave out a call of the operator.
constexpr auto beyond_all = std::size_t(1) << 56;
constexpr std::align_val_t alignment{64};

TEST(Allocate, WhatCannotBeHadIsAnException) {
  EXPECT_THROW((void)::operator new(beyond_all), std::bad_alloc);
  EXPECT_THROW((void)::operator new[](beyond_all), std::bad_alloc);
  EXPECT_THROW((void)::operator new(beyond_all, alignment), std::bad_alloc);
  EXPECT_THROW((void)::operator new[](beyond_all, alignment), std::bad_alloc);
}

TEST(Allocate, OrNothingWhereThatIsAskedFor) {
  EXPECT_EQ(::operator new(beyond_all, std::nothrow), nullptr);
  EXPECT_EQ(::operator new[](beyond_all, std::nothrow), nullptr);
  EXPECT_EQ(::operator new(beyond_all, alignment, std::nothrow), nullptr);
  EXPECT_EQ(::operator new[](beyond_all, alignment, std::nothrow), nullptr);
}

TEST(Allocate, WhatIsHadIsAligned) {
  for (std::size_t size = 1; size < 100'000; size = size * 3 + 1) {
    void* memory = ::operator new(size, alignment);
    EXPECT_EQ(reinterpret_cast<std::size_t>(memory) % 64, 0u) << size;
    ::operator delete(memory, alignment);
  }
}

}  // namespace
}  // namespace nightcity
