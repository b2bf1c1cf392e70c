#include "formats/file_names.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "support/error_message.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

TEST(ScratchFolder, IsTmpdirWhichMustBeThere) {
  const test::TempFolder folder;
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  EXPECT_EQ(scratch_folder(), folder.path());
  ::setenv("TMPDIR", (folder / "absent").c_str(), 1);
  const std::string message = test::message_of([] { scratch_folder(); });
  if (before)
    ::setenv("TMPDIR", kept.c_str(), 1);
  else
    ::unsetenv("TMPDIR");
  EXPECT_NE(message.find("absent"), std::string::npos);
  EXPECT_NE(message.find("TMPDIR"), std::string::npos);
}

}  // namespace
}  // namespace nightcity
