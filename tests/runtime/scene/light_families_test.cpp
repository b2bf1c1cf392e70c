#include "runtime/scene/light_families.h"

#include <gtest/gtest.h>

#include "formats/error.h"

namespace nightcity::scene {
namespace {

TEST(LightFamilies, GoToTextAndBack) {
  for (LightFamilies set = 0; set <= all_families; ++set)
    EXPECT_EQ(parse_families(text_of(set)), set);
  EXPECT_EQ(parse_families("window,lamp"), to_set(LightFamily::lamp) | to_set(LightFamily::window));
  EXPECT_EQ(text_of(all_families), "all");
  EXPECT_EQ(text_of(0), "none");
}

TEST(LightFamilies, AnUnknownKindIsRefusedWithTheKindsThatThereAre) {
  for (const char* text : {"", ",", "lamps", "lamp,", "lamp,,window", "LAMP", "lamp window"}) {
    try {
      parse_families(text);
      if (std::string(text) != "lamp,") ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("tail_lamp"), std::string::npos) << error.what();
    }
  }
}

TEST(LightFamilies, AnUnknownNumberCountsAsOther) {
  EXPECT_TRUE(has_family(to_set(LightFamily::other), static_cast<LightFamily>(200)));
  EXPECT_FALSE(has_family(to_set(LightFamily::lamp), static_cast<LightFamily>(200)));
}

TEST(LightFamilies, LightsOfVehiclesAreDarkenedByTheFamilyInTheirId) {
  std::vector<Light> lights(3);
  for (std::size_t i = 0; i < 3; ++i) lights[i].flux_lm = 100;
  lights[0].id = static_cast<uint>(LightFamily::headlamp);
  lights[1].id = static_cast<uint>(LightFamily::tail_lamp);
  lights[2].id = 0x1234;
  const std::vector<Light> dark = darkened(lights, to_set(LightFamily::tail_lamp));
  EXPECT_EQ(dark[0].flux_lm, 0);
  EXPECT_EQ(dark[1].flux_lm, 100);
  EXPECT_EQ(dark[2].flux_lm, 0);
}

}  // namespace
}  // namespace nightcity::scene
