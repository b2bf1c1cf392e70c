#include "tools/lights/lamp_tags.h"

#include <gtest/gtest.h>

#include "formats/colour.h"
#include "tools/lights/lit_tag.h"

namespace nightcity::lights {
namespace {

TEST(LampTags, ColourTemperaturesAsNumbersAndWords) {
  EXPECT_EQ(parse_cct_k("3000"), 3000);
  EXPECT_EQ(parse_cct_k("3000 K"), 3000);
  EXPECT_EQ(parse_cct_k("3000k"), 3000);
  EXPECT_EQ(parse_cct_k("Warm White"), 2850);
  EXPECT_EQ(parse_cct_k("nonsense;4000 K"), 4000);
  EXPECT_EQ(parse_cct_k("3,000 K"), 3000);
  EXPECT_EQ(parse_cct_k("3.000"), 3000);
  EXPECT_EQ(parse_cct_k("2 700-3 000 K"), 2850);
  EXPECT_EQ(parse_cct_k("4000 \xc2\xb0K"), 4000);
  EXPECT_EQ(parse_cct_k("830"), 3000);
  EXPECT_EQ(parse_cct_k("727"), 2700);
  EXPECT_EQ(parse_cct_k("965"), 6500);
  for (const char* text :
       {"", "3 K", "560 nm", "30000000", "blue", "830 K", "530", "899", "8.0", "8-3"})
    EXPECT_FALSE(parse_cct_k(text)) << text;
}

TEST(LampTags, WattsOfSeveralTubesAreThoseOfALuminaire) {
  EXPECT_EQ(read_lamp_tags({{"light:power", "2x36 W"}}).power_w, 72);
  EXPECT_EQ(read_lamp_tags({{"light:power", "2x36 W"}, {"light:count", "2"}}).power_w, 36);
  EXPECT_EQ(read_lamp_tags({{"light:power", "2x36 W"}, {"light:count", "3"}}).power_w, 72);
  EXPECT_EQ(read_lamp_tags({{"light:power", "72 W"}, {"light:count", "2"}}).power_w, 72);
}

TEST(LampTags, EachDirectionIsALuminaire) {
  const LampTags two = read_lamp_tags({{"light:direction", "90,270"}});
  EXPECT_EQ(two.directions_degrees, (std::vector<double>{90, 270}));
  EXPECT_EQ(two.count, 2);
  EXPECT_EQ(read_lamp_tags({{"light:direction", "N;S;E"}, {"light:count", "1"}}).count, 3);
  EXPECT_EQ(read_lamp_tags({{"light:direction", "N;S"}, {"light:count", "4"}}).count, 4);
  const LampTags crowd = read_lamp_tags({{"direction", "1;2;3;4;5;6;7;8;9;10;11;12;13"}});
  EXPECT_EQ(crowd.count, 1);
  EXPECT_EQ(crowd.unread.size(), 1u);
}

TEST(LampTags, LampTypesAsPeopleSpellThem) {
  EXPECT_EQ(parse_lamp_type("LED"), LampType::led);
  EXPECT_EQ(parse_lamp_type("high_pressure_sodium"), LampType::high_pressure_sodium);
  EXPECT_EQ(parse_lamp_type("High-Pressure Sodium"), LampType::high_pressure_sodium);
  EXPECT_EQ(parse_lamp_type("SON"), LampType::high_pressure_sodium);
  EXPECT_EQ(parse_lamp_type("SOX"), LampType::low_pressure_sodium);
  EXPECT_EQ(parse_lamp_type("gaslight"), LampType::gas);
  EXPECT_EQ(parse_lamp_type("whatever;led"), LampType::led);
  EXPECT_EQ(parse_lamp_type("SON-T"), LampType::high_pressure_sodium);
  EXPECT_EQ(parse_lamp_type("HSE"), LampType::high_pressure_sodium);
  EXPECT_EQ(parse_lamp_type("HIT"), LampType::metal_halide);
  EXPECT_EQ(parse_lamp_type("HME"), LampType::mercury);
  EXPECT_EQ(parse_lamp_type("ceramic_metal_halide"), LampType::metal_halide);
  EXPECT_FALSE(parse_lamp_type("plasma"));
}

TEST(LampTags, WholeLampsFromRealExtracts) {
  const LampTags gas = read_lamp_tags({{"highway", "street_lamp"},
                                       {"lamp_type", "gaslight"},
                                       {"lamp_flames", "4"},
                                       {"height", "4"}});
  EXPECT_EQ(gas.type, LampType::gas);
  EXPECT_EQ(gas.flux_lm, 4 * gas_lumen_per_flame);
  EXPECT_EQ(gas.height_m, 4);
  const LampTags fake =
      read_lamp_tags({{"lamp_type", "gaslight"}, {"fake_gaslight", "yes"}, {"lamp_flames", "4"}});
  EXPECT_EQ(fake.type, LampType::led);
  EXPECT_FALSE(fake.flux_lm);
  const LampTags berlin = read_lamp_tags({{"lamp_mount", "straight_mast"},
                                          {"lamp_type", "electric"},
                                          {"light:mount", "1"},
                                          {"light:lit", "dusk-dawn"}});
  EXPECT_EQ(berlin.mount, LampMount::straight_mast);
  EXPECT_FALSE(berlin.type);
  EXPECT_FALSE(berlin.unlit);
  EXPECT_TRUE(berlin.unread.empty());
  EXPECT_TRUE(read_lamp_tags({{"tower:type", "lighting"}}).mast);
}

TEST(LampTags, CountsListsColoursAndTilt) {
  const LampTags twin =
      read_lamp_tags({{"light:count", "2"}, {"light:direction", "90;270"}, {"light:tilt", "-60"}});
  EXPECT_EQ(twin.count, 2);
  ASSERT_EQ(twin.directions_degrees.size(), 2u);
  EXPECT_EQ(twin.tilt_degrees, 30);
  EXPECT_EQ(read_lamp_tags({{"direction", "N;E;S"}}).count, 3);
  EXPECT_EQ(read_lamp_tags({{"light:colour", "3000 K"}}).cct_k, 3000);
  const LampTags orange = read_lamp_tags({{"light:colour", "orange"}});
  ASSERT_TRUE(orange.colour);
  EXPECT_GT(orange.colour->r, orange.colour->g);
  EXPECT_TRUE(read_lamp_tags({{"light:colour", "#ffd9a0"}}).colour);
  EXPECT_TRUE(read_lamp_tags({{"lit", "No"}}).unlit);
  EXPECT_TRUE(read_lamp_tags({{"disused", "yes"}}).unlit);
}

TEST(LampTags, ThousandsOfLumensAndWattsAreNoDecimals) {
  EXPECT_EQ(read_lamp_tags({{"light:luminous_flux", "12,000 lm"}}).flux_lm, 12000);
  EXPECT_EQ(read_lamp_tags({{"light:power", "1,000 W"}}).power_w, 1000);
  EXPECT_EQ(read_lamp_tags({{"light:power", "70,000"}}).power_w, 70);
}

TEST(LampTags, WhatCannotBeReadOrBelievedIsTold) {
  const LampTags lamp = read_lamp_tags({{"height", "tall"},
                                        {"light:count", "9999"},
                                        {"lamp_type", "plasma"},
                                        {"direction", "left"},
                                        {"light:colour", "mauve"}});
  EXPECT_FALSE(lamp.height_m);
  EXPECT_EQ(lamp.count, 1);
  EXPECT_FALSE(lamp.type);
  EXPECT_EQ(lamp.unread.size(), 5u);
  EXPECT_TRUE(lamp.unread.contains("height=tall"));
  EXPECT_FALSE(read_lamp_tags({{"height", "600"}}).height_m);  // a lamp 600 m high
}

TEST(LampTags, ColoursAreThoseOfCss) {
  const auto colour = [](const char* text) {
    return read_lamp_tags({{"light:colour", text}}).colour.value_or(glm::vec3(0));
  };
  const glm::vec3 gold = rec709_from_rgb(0xFFD700).value();
  for (const char* text : {"gold", "Gold", "#FFD700", "ffd700", "#ffd700ff", "rgb(255, 215, 0)",
                           "gold;white", "rgba(255,215,0,0.5)"})
    EXPECT_EQ(colour(text), gold) << text;
  EXPECT_EQ(colour("light sky blue"), rec709_from_rgb(0x87CEFA).value());
  EXPECT_EQ(colour("#fa0"), rec709_from_rgb(0xFFAA00).value());
  // Words of lamps go first: their white is none of screens.
  EXPECT_EQ(read_lamp_tags({{"light:colour", "white"}}).cct_k, 4000);
  // The first of a list is taken.
  EXPECT_FALSE(read_lamp_tags({{"light:colour", "red;white"}}).cct_k);
  for (const char* text : {"black", "#ggg", "rgb(300,0,0)", "rgb(1,2", "0x00ff00", "#12345"})
    EXPECT_EQ(read_lamp_tags({{"light:colour", text}}).unread.size(), 1u) << text;
}

TEST(LampTags, ColoursInEverySpelling) {
  EXPECT_EQ(read_lamp_tags({{"light:colour", "3000-4000"}}).cct_k, 3500);
  EXPECT_TRUE(read_lamp_tags({{"light:colour", "#fff"}}).colour);
  EXPECT_TRUE(read_lamp_tags({{"light:colour", "red"}}).colour);
  for (const char* text : {"#ffa500", "#ff0000", "#123456"}) {
    const auto colour = rec709_from_hex(text);
    const auto again = rec709_from_hex(to_hex(*colour));
    for (int n = 0; n < 3; ++n)
      EXPECT_NEAR((*again)[n], (*colour)[n], 0.03 * (*colour)[n] + 0.01) << text;
  }
}

// OSM wiki, "Key:support", "Key:lamp_mount", "Key:light:method".
TEST(LampTags, WordsOfMappersForMountsTypesAndColours) {
  const auto mount = [](const char* word) { return read_lamp_tags({{"support", word}}).mount; };
  for (const char* post : {"lamppost", "street_lamp", "pedestal", "tower"})
    EXPECT_EQ(mount(post), LampMount::straight_mast) << post;
  for (const char* wall : {"building", "bracket", "roof", "bridge"})
    EXPECT_EQ(mount(wall), LampMount::wall) << wall;
  EXPECT_EQ(mount("tree"), LampMount::suspended);
  EXPECT_EQ(parse_lamp_type("Natriumdampf"), LampType::high_pressure_sodium);
  EXPECT_EQ(parse_lamp_type("LED_retrofit"), LampType::led);
  EXPECT_TRUE(read_lamp_tags({{"light:method", "electrical"}}).unread.empty());
  EXPECT_EQ(parse_cct_k("warmwei\xc3\x9f"), 2850);
  EXPECT_EQ(parse_cct_k("K3000"), 3000);
  EXPECT_FALSE(parse_cct_k("K"));
}

TEST(LampTags, ColoursOfLightUnderOtherKeys) {
  for (const char* key : {"light:temperature", "light:colour:temperature",
                          "light:color_temperature", "color_temperature"})
    EXPECT_EQ(read_lamp_tags({{key, "2700"}}).cct_k, 2700) << key;
  EXPECT_EQ(parse_cct_k("4000 К"), 4000);
  const LampTags angled = read_lamp_tags({{"lamp_mount", "angled_mast"}});
  EXPECT_EQ(angled.mount, LampMount::bent_mast);
  EXPECT_TRUE(angled.unread.empty());
}

// Keys and words of Brazil, Japan, the Netherlands, Poland, India and the United States.
TEST(LampTags, KeysAndWordsOfSeveralCountries) {
  for (const char* key :
       {"lamp:height", "lamp_height", "mounting_height", "light:mounting_height", "pole:height"})
    EXPECT_FLOAT_EQ(*read_lamp_tags({{key, "30 ft"}}).height_m, 9.144F) << key;
  for (const char* key : {"light:wattage", "lamp:wattage", "lamp_wattage"})
    EXPECT_FLOAT_EQ(*read_lamp_tags({{key, "100 W"}}).power_w, 100) << key;
  for (const osm::OsmTags& tags : {osm::OsmTags{{"light:count", "2 lamps"}},
                                   {{"lamps", "2"}},
                                   {{"lamp:count", "2"}},
                                   {{"light:count", "double"}}})
    EXPECT_EQ(read_lamp_tags(tags).count, 2);
  const std::pair<const char*, LampType> types[] = {
      {"vapor de sódio", LampType::high_pressure_sodium},
      {"Sodowa", LampType::high_pressure_sodium},
      {"natriumlamp", LampType::high_pressure_sodium},
      {"高圧ナトリウムランプ", LampType::high_pressure_sodium},
      {"HPS 150W", LampType::high_pressure_sodium},
      {"Sodium Vapour Lamp", LampType::high_pressure_sodium},
      {"lampa sodowa", LampType::high_pressure_sodium},
      {"lâmpada de sódio", LampType::high_pressure_sodium},
      {"LED 4000K", LampType::led},
      {"水銀灯", LampType::mercury},
      {"rtęciowa", LampType::mercury},
      {"vapor metálico", LampType::metal_halide},
      {"蛍光灯", LampType::fluorescent}};
  for (const auto& [word, type] : types) EXPECT_EQ(parse_lamp_type(word), type) << word;
  EXPECT_FALSE(parse_lamp_type("Lampe 7"));
  EXPECT_EQ(read_lit_tag("yes (LED)", Half::north).kind, LitTag::Kind::lit);
  for (const char* no : {"não", "nie", "nee", "nein", "unlit", "no (broken)"})
    EXPECT_EQ(read_lit_tag(no, Half::north).kind, LitTag::Kind::dark) << no;
}

}  // namespace
}  // namespace nightcity::lights
