#include "runtime/render/presets.h"

#include <gtest/gtest.h>

#include <set>

#include "formats/error.h"
#include "runtime/render/setting_table.h"

namespace nightcity::render {
namespace {

bool none(const std::string&) {
  return false;
}

TEST(Presets, EveryClassHasEveryNameOnceAndSettingsThatExist) {
  std::set<std::string> names;
  for (const Setting& setting : list_settings()) names.insert(setting.name);
  std::set<std::pair<std::string, std::string>> seen;
  for (const Preset& preset : list_presets()) {
    EXPECT_TRUE(seen.insert({preset.device_class, preset.name}).second) << preset.name;
    RenderSettings settings;
    apply_preset(preset.device_class, preset.name, settings, none);
    EXPECT_NO_THROW(check_settings(settings));
    for (const auto& [name, word] : read_preset(preset.device_class, preset.name)) {
      EXPECT_TRUE(names.count(name)) << name;
      for (const Setting& setting : list_settings())
        if (name == setting.name) {
          EXPECT_EQ(text_of(setting, settings), word);
        }
    }
  }
  for (const char* device_class : {"cpu", "gpu"})
    for (const std::string& name : list_preset_names())
      EXPECT_TRUE(seen.count({device_class, name})) << device_class << " " << name;
  EXPECT_EQ(seen.size(), 2 * list_preset_names().size());
}

TEST(Presets, AreUnbiasedAndGrowFromFastToAccurate) {
  for (const char* device_class : {"cpu", "gpu"}) {
    RenderSettings before;
    before.sampling.candidates = 0;
    before.reuse.neighbours = 0;
    for (const char* name : {"fast", "balanced", "accurate"}) {
      RenderSettings settings;
      apply_preset(device_class, name, settings, none);
      EXPECT_FALSE(traits_of(settings.sampling.estimator).as_published) << name;
      EXPECT_GE(settings.sampling.candidates + 8 * settings.reuse.neighbours,
                before.sampling.candidates + 8 * before.reuse.neighbours)
          << name;
      before = settings;
    }
    RenderSettings reference;
    apply_preset(device_class, "reference", reference, none);
    EXPECT_EQ(reference.sampling.estimator, Estimator::reference);
  }
}

TEST(Presets, LeaveAloneWhatIsGiven) {
  RenderSettings settings;
  settings.sampling.candidates = 77;
  apply_preset("gpu", "fast", settings,
               [](const std::string& name) { return name == "candidates"; });
  EXPECT_EQ(settings.sampling.candidates, 77u);
  EXPECT_THROW(apply_preset("gpu", "faster", settings, none), UsageError);
}

TEST(Presets, KnowTwoClassesOfDevices) {
  EXPECT_EQ(find_device_class("cpu"), "cpu");
  for (const char* kind : {"discrete", "integrated", "virtual", "other", ""})
    EXPECT_EQ(find_device_class(kind), "gpu");
}

}  // namespace
}  // namespace nightcity::render
