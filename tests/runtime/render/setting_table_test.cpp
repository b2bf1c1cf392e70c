#include "runtime/render/setting_table.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "formats/error.h"

namespace nightcity::render {
namespace {

TEST(SettingTable, NamesAndAliasesAreUnique) {
  std::set<std::string> names;
  for (const Setting& setting : list_settings()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    for (const char* alias : setting.aliases) EXPECT_TRUE(names.insert(alias).second) << alias;
  }
}

TEST(SettingTable, DefaultsAreInRangeAndSurviveTheirText) {
  EXPECT_NO_THROW(check_settings({}));
  for (const Setting& setting : list_settings()) {
    RenderSettings settings;
    set_from_text(setting, settings, text_of(setting, {}));
    EXPECT_TRUE(have_same_estimate(settings, {})) << setting.name;
    EXPECT_EQ(text_of(setting, settings), text_of(setting, {})) << setting.name;
  }
}

TEST(SettingTable, NoSettingTakesNanOrWordsThatItDoesNotKnow) {
  for (const Setting& setting : list_settings())
    for (const char* word : {"nan", "-nan", "inf", "many", "", "-1", "1e30", "0.5x"}) {
      RenderSettings settings;
      EXPECT_THROW(set_from_text(setting, settings, word), UsageError)
          << setting.name << " " << word;
    }
}

TEST(SettingTable, NumbersOutOfRangeAreRefusedHoweverTheyCameIn) {
  for (const Setting& setting : list_settings()) {
    RenderSettings settings;
    const Setting::Value value = setting.value(settings);
    if (const auto number = std::get_if<float*>(&value)) {
      for (const float bad :
           {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f,
            float(setting.max) * 2}) {
        **number = bad;
        EXPECT_THROW(check_settings(settings), UsageError) << setting.name << " " << bad;
      }
    }
    const auto count = std::get_if<std::uint32_t*>(&value);
    if (count && setting.max < std::numeric_limits<std::uint32_t>::max()) {
      **count = static_cast<std::uint32_t>(setting.max) + 1;
      EXPECT_THROW(check_settings(settings), UsageError) << setting.name;
    }
  }
}

// A setting that these groups hold and that does not restart the mean would mix two estimates in
// it.
TEST(SettingTable, EverySettingOfSamplingReuseAndEnvironmentChangesTheEstimate) {
  for (const Setting& setting : list_settings()) {
    RenderSettings settings;
    std::visit([](auto* value) { *value = {}; }, setting.value(settings));
    if (text_of(setting, settings) == text_of(setting, {}))
      std::visit(
          [](auto* value) { *value = static_cast<std::remove_pointer_t<decltype(value)>>(1); },
          setting.value(settings));
    EXPECT_EQ(have_same_estimate(settings, {}), setting.group == SettingGroup::display)
        << setting.name;
  }
}

TEST(EstimatorTraits, NamesAreFoundAndOthersRefused) {
  for (const EstimatorTraits& traits : list_estimators()) {
    EXPECT_EQ(find_estimator(traits.name), traits.estimator);
    EXPECT_STREQ(name_of(traits.estimator), traits.name);
  }
  EXPECT_THROW(find_estimator("magic"), UsageError);
}

}  // namespace
}  // namespace nightcity::render
