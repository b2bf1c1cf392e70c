#include "formats/mapped_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/error_message.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

TEST(MappedFile, RefusesAFifoAtOnce) {
  const test::TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_NE(
      test::message_of([&] { MappedFile file(folder / "fifo"); }).find("is not a regular file"),
      std::string::npos);
}

}  // namespace
}  // namespace nightcity
