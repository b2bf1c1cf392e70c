#include "formats/scratch_file.h"

#include <gtest/gtest.h>

#include <string_view>

#include "support/temp_folder.h"

namespace nightcity {
namespace {

TEST(ScratchFile, HasNoNameAndNeedsNoRoomBesideADevice) {
  const test::TempFolder folder;
  ScratchFile beside(folder / "a"), device("/dev/null");
  for (ScratchFile* file : {&beside, &device}) {
    file->write("text", 4);
    char back[4];
    file->read(0, back, 4);
    EXPECT_EQ(std::string_view(back, 4), "text");
  }
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace nightcity
