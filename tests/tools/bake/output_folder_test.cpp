#include "tools/bake/output_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/signals.h"
#include "support/temp_folder.h"

namespace nightcity::bake {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

constexpr const char* names[] = {"city.glb", "city.lights", "report"};

void stage(OutputFolder& output, const std::string& text) {
  for (const char* name : names) {
    AtomicFile file(output.staged(name));
    file.write(text);
    file.commit();
  }
}

void expect_city(const fs::path& folder, const std::string& text) {
  for (const char* name : names) EXPECT_EQ(test::read_text(folder / name), text) << name;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 3) << "something was left";
}

TEST(OutputFolder, LeavesAllFilesAndNothingElse) {
  const TempFolder folder;
  for (const char* text : {"first", "second"}) {
    OutputFolder output(folder / "a/b");
    stage(output, text);
    output.commit();
  }
  expect_city(folder / "a/b", "second");
}

TEST(OutputFolder, TakesAwayWhatItMadeAndNothingOfOthers) {
  const TempFolder folder;
  { OutputFolder output(folder / "a/b/c"); }
  EXPECT_EQ(folder.entries(), 0u);
  {
    // Meanwhile another bake finishes below the topmost folder that this one has made, and somebody
    // keeps notes.
    OutputFolder failing(folder / "a/b/c"), other(folder / "a/d");
    stage(failing, "lost");
    stage(other, "kept");
    other.commit();
    test::write_text(folder / "a/b/notes", "mine");
  }
  expect_city(folder / "a/d", "kept");
  EXPECT_EQ(test::read_text(folder / "a/b/notes"), "mine");
  EXPECT_FALSE(fs::exists(folder / "a/b/c"));
}

TEST(OutputFolder, AFolderThatCannotBeLeavesNoneOfItsParents) {
  const TempFolder folder;
  const std::string too_long(300, 'x');
  EXPECT_THROW(OutputFolder(folder / "new/below" / too_long), Error);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(OutputFolder, AMoveThatFailsUndoesTheOthers) {
  const TempFolder folder;
  {
    OutputFolder output(folder.path());
    stage(output, "old");
    output.commit();
  }
  OutputFolder output(folder.path());
  stage(output, "new");
  // In the way of the old third file, after the first two have been moved.
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (entry.is_directory()) fs::create_directories(entry.path() / "old/report/in-the-way");
  EXPECT_THROW(output.commit(), Error);
  for (const char* name : names) EXPECT_EQ(test::read_text(folder / name), "old") << name;
}

TEST(OutputFolder, AFolderInTheWayIsSeenBeforeAnythingMoves) {
  const TempFolder folder;
  fs::create_directory(folder / "report");
  test::write_text(folder / "city.glb", "old");
  {
    OutputFolder output(folder.path());
    stage(output, "new");
    EXPECT_THROW(output.commit(), Error);
  }
  EXPECT_EQ(test::read_text(folder / "city.glb"), "old");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(OutputFolder, LinksAreFollowedAndDevicesStay) {
  const TempFolder folder;
  fs::create_directories(folder / "out");
  test::write_text(folder / "disk", "old");
  fs::create_symlink("../disk", folder / "out/city.glb");
  fs::create_symlink("/dev/null", folder / "out/report");
  OutputFolder output(folder / "out");
  stage(output, "new");
  output.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "out/city.glb"));
  EXPECT_TRUE(fs::is_symlink(folder / "out/report"));
  EXPECT_EQ(test::read_text(folder / "disk"), "new");
  EXPECT_EQ(test::read_text(folder / "out/city.lights"), "new");
  EXPECT_EQ(fs::status("/dev/null").type(), fs::file_type::character);
}

// Runs `action` in a child that a signal then ends, without destructors.
void run_and_end(int signal, const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::raise(signal);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(OutputFolder, TheNextBakeRemovesWhatAKilledOneLeft) {
  const TempFolder folder;
  run_and_end(SIGKILL, [&] {
    auto* output = new OutputFolder(folder.path());
    stage(*output, "killed");
  });
  EXPECT_EQ(folder.entries(), 1u);
  OutputFolder output(folder.path());
  EXPECT_EQ(folder.entries(), 1u) << "its own hidden folder alone";
  stage(output, "next");
  output.commit();
  expect_city(folder.path(), "next");
}

TEST(OutputFolder, ABakeAtWorkIsLeftAlone) {
  const TempFolder folder;
  OutputFolder first(folder.path());
  stage(first, "first");
  { OutputFolder second(folder.path()); }
  first.commit();
  expect_city(folder.path(), "first");
}

// The states that a kill within commit() can leave, made by hand after its description in
// output_folder.h.
TEST(OutputFolder, AMoveThatWasCutIsFinishedByTheNextBake) {
  for (int old_moved = 0; old_moved <= 3; ++old_moved)
    for (int new_moved = 0; new_moved <= (old_moved == 3 ? 3 : 0); ++new_moved) {
      const TempFolder folder;
      const fs::path hidden = folder / ".nightbake-abc123", out = folder.path();
      fs::create_directories(hidden / "old");
      std::string journal;
      for (int n = 0; n < 3; ++n) {
        journal += std::string(names[n]) + "\n";
        test::write_text((n < old_moved ? hidden / "old" : out) / names[n], "old");
      }
      // The first name appears last.
      for (int n = 0; n < 3; ++n)
        test::write_text((3 - n <= new_moved ? out : hidden) / names[n], "new");
      test::write_text(hidden / "commit", journal);
      EXPECT_TRUE(!fs::exists(out / "city.glb") || old_moved == 0 || new_moved == 3);
      { OutputFolder next(out); }
      expect_city(out, "new");
    }
}

// "index" names two files in a folder of their own, which another program uses as well.
void stage_index(OutputFolder& output, const std::string& text) {
  for (const char* name : {"index", "parts/a", "parts/b"}) {
    AtomicFile file(output.staged(name));
    file.write(text);
    file.commit();
  }
}

TEST(OutputFolder, FilesMayLieInAFolderOfTheirOwn) {
  const TempFolder folder;
  fs::create_directories(folder / "out/parts");
  test::write_text(folder / "out/parts/notes", "mine");
  for (const char* text : {"first", "second"}) {
    OutputFolder output(folder / "out");
    stage_index(output, text);
    output.commit();
    for (const char* name : {"out/index", "out/parts/a", "out/parts/b"})
      EXPECT_EQ(test::read_text(folder / name), text) << name;
  }
  EXPECT_EQ(test::read_text(folder / "out/parts/notes"), "mine");
  EXPECT_EQ(std::distance(fs::recursive_directory_iterator(folder / "out"), {}), 5);
}

TEST(OutputFolder, AFolderOfItsOwnGoesWithWhatFails) {
  const TempFolder folder;
  fs::create_directory(folder / "index");  // in the way
  {
    OutputFolder output(folder.path());
    stage_index(output, "lost");
    EXPECT_THROW(output.commit(), Error);
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(OutputFolder, ASignalLeavesNothingOfAFolderOfItsOwn) {
  const TempFolder folder;
  run_and_end(SIGTERM, [&] {
    install_signal_handlers("test");
    auto* output = new OutputFolder(folder / "new/out");
    stage_index(*output, "lost");
    // More names than a reading of the folder returns at once.
    for (int i = 0; i < 500; ++i)
      test::write_text(output->staged("parts/" + std::string(40, 'x') + std::to_string(i)), "");
  });
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(OutputFolder, AMoveIntoAFolderOfItsOwnIsFinishedByTheNext) {
  const TempFolder folder;
  const fs::path hidden = folder / ".nightbake-abc123";
  fs::create_directories(hidden / "parts");
  for (const char* name : {"index", "parts/a"}) test::write_text(hidden / name, "new");
  test::write_text(folder / "outside", "mine");
  test::write_text(hidden / "commit", "index\nparts/a\n../outside\nparts/../../outside\n");
  { OutputFolder next(folder.path()); }
  EXPECT_EQ(test::read_text(folder / "index"), "new");
  EXPECT_EQ(test::read_text(folder / "parts/a"), "new");
  EXPECT_EQ(test::read_text(folder / "outside"), "mine");
  EXPECT_EQ(folder.entries(), 3u);
}

TEST(OutputFolder, AHiddenFolderOfAnotherNameIsNotOurs) {
  const TempFolder folder;
  for (const char* name : {".nightbake-", ".nightbake-notes", ".nightbake"}) {
    fs::create_directory(folder / name);
    test::write_text(folder / name / "commit", "city.glb\n");
  }
  { OutputFolder output(folder.path()); }
  EXPECT_EQ(folder.entries(), 3u);
}

}  // namespace
}  // namespace nightcity::bake
