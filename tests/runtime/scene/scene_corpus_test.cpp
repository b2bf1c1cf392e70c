// Every scene that the fuzzer starts from or has found, loaded in each test run.
#include <gtest/gtest.h>

#include "support/corpus.h"
#include "tests/runtime/scene/sound_scene.h"

namespace nightcity::scene {
namespace {

const auto scene_corpus =
    std::filesystem::path(NIGHTCITY_SOURCE_DIR) / "tests/runtime/scene/corpus_scenes";

TEST(SceneCorpus, EveryFileIsLoadedOrRefused) {
  test::expect_sound_files(scene_corpus, 3, test::find_fault_of_scene);
}

TEST(SceneCorpus, HoldsScenesWithTheirHierarchies) {
  for (const char* name : {"town.glb", "turned.glb", "draco.glb"})
    EXPECT_EQ(load_render_scene(scene_corpus / name).stored_hierarchies, 2u) << name;
}

}  // namespace
}  // namespace nightcity::scene
