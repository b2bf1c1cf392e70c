// Streets found by what people type, and views along them.
#include "runtime/scene/street_names.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "formats/error.h"
#include "runtime/scene/fold_name.h"
#include "runtime/scene/named_street_view.h"
#include "runtime/scene/trace_ray.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

using scene::fold_name;

TEST(FoldName, LeavesLettersWithoutCaseDiacriticsAndMarks) {
  EXPECT_EQ(fold_name("Karl-Marx-Straße"), "karl marx strasse");
  EXPECT_EQ(fold_name("  Unter  den Linden "), "unter den linden");
  EXPECT_EQ(fold_name("Gärtnerstraße"), "gartnerstrasse");
  EXPECT_EQ(fold_name("Ga\u0308rtner"), "gartner");  // decomposed, as some systems type it
  EXPECT_EQ(fold_name("Čáslavská"), "caslavska");
  EXPECT_EQ(fold_name("Plac Żołnierza"), "plac zolnierza");
  EXPECT_EQ(fold_name("Rue de l’Œuvre"), "rue de l oeuvre");
  EXPECT_EQ(fold_name("Strøget"), "stroget");
  EXPECT_EQ(fold_name("Đường Nguyễn Huệ"), "duong nguyen hue");
  EXPECT_EQ(fold_name("İstiklâl Caddesi"), "istiklal caddesi");
  EXPECT_EQ(fold_name("НЕВСКИЙ"), fold_name("невский"));
  EXPECT_EQ(fold_name("ΕΡΜΟΥ"), fold_name("ερμου"));
  EXPECT_EQ(fold_name("銀座"), "銀座");
  EXPECT_EQ(fold_name("𠮷野"), "𠮷野");
  EXPECT_EQ(fold_name("-- "), "");
}

TEST(FoldName, TakesAnyBytes) {
  for (int a = 0; a < 256; ++a)
    for (const char* rest : {"", "\x80", "\xff\xff", "abc"})
      EXPECT_NO_THROW(fold_name(std::string(1, static_cast<char>(a)) + rest));
}

std::vector<std::string> find(const std::vector<NamedStreet>& streets, const std::string& text) {
  std::vector<std::string> names;
  for (const std::size_t i : scene::find_streets(streets, text)) names.push_back(streets[i].name);
  return names;
}

TEST(FindStreets, OtherNamesLeadThereToo) {
  const std::vector<std::vector<glm::dvec2>> line{{{0, 0}, {10, 0}}};
  const std::vector<NamedStreet> streets{
      {"Platz der Luftbrücke", line, {"Kreuz der Helden"}},
      {"御堂筋", line, {"Midōsuji", "国道25号", "25"}},
      {"Helden", line},
      {"Karl-Marx-Allee", line, {"Stalinallee", "Große Frankfurter Straße"}},
      {"Frankfurter Allee", line, {"B 1"}}};
  EXPECT_EQ(find(streets, "midosuji"), (std::vector<std::string>{"御堂筋"}));
  EXPECT_EQ(find(streets, "stalinallee"), (std::vector<std::string>{"Karl-Marx-Allee"}));
  EXPECT_EQ(find(streets, "b 1"), (std::vector<std::string>{"Frankfurter Allee"}));
  EXPECT_EQ(find(streets, "helden"), (std::vector<std::string>{"Helden", "Platz der Luftbrücke"}));
  EXPECT_EQ(find(streets, "frankfurter"),
            (std::vector<std::string>{"Frankfurter Allee", "Karl-Marx-Allee"}));
}

TEST(FindStreets, TheBestComesFirst) {
  const std::vector<std::vector<glm::dvec2>> line{{{0, 0}, {10, 0}}};
  const std::vector<NamedStreet> streets{{"Am Lindenplatz", line},    {"Unter den Linden", line},
                                         {"Lindenstraße", line},      {"Kurlindenweg", line},
                                         {"Straße der Linden", line}, {"Linden", line}};
  EXPECT_EQ(find(streets, "linden"),
            (std::vector<std::string>{"Linden", "Lindenstraße", "Am Lindenplatz",
                                      "Unter den Linden", "Straße der Linden", "Kurlindenweg"}));
  EXPECT_EQ(find(streets, "UNTER DEN LINDEN"), (std::vector<std::string>{"Unter den Linden"}));
  EXPECT_EQ(find(streets, "strasse").size(), 2u);
  EXPECT_EQ(find(streets, "Straße").front(), "Straße der Linden");
  EXPECT_TRUE(find(streets, "Broadway").empty());
  EXPECT_TRUE(find(streets, " - ").empty());
  const std::vector<NamedStreet> same{{"A", {{{0, 0}, {10, 0}}}}, {"A", {{{0, 0}, {90, 0}}}}};
  EXPECT_EQ(scene::find_streets(same, "a").front(), 1u);  // the longest
}

// Two streets that cross, 14 m wide, between houses.
scene::RenderScene crossing() {
  SceneBuilder builder;
  builder.ground(150);
  for (const float x : {-100.0f, 7.0f})
    for (const float z : {-100.0f, 7.0f}) builder.box({x, 0, z}, {x + 93, 12, z + 93});
  scene::RenderScene scene = builder.with({});
  scene.places.streets = {{"West-East", {{{-90, 0}, {90, 0}}}},
                          {"North-South", {{{0, -90}, {0, 90}}}},
                          {"Crossing", {{{0, 0}}}},
                          {"Inside", {{{15, 50}, {15, 60}}}},
                          {"Far", {{{5000, 0}, {6000, 0}}}}};
  return scene;
}

TEST(NamedStreetView, StandsOnTheStreetAndLooksAlongIt) {
  const scene::RenderScene scene = crossing();
  for (const auto& [name, along] : {std::pair{"west", glm::vec3(1, 0, 0)}, {"south", {0, 0, 1}}}) {
    const scene::CameraPose pose = scene::find_camera(std::string("street:") + name, scene);
    const glm::vec3 ahead = glm::normalize(pose.target - pose.position);
    EXPECT_GT(std::abs(glm::dot(ahead, along)), 0.99f) << name;
    EXPECT_NEAR(pose.position.y, 1.7, 0.01);
    const glm::vec3 off = pose.position - along * glm::dot(along, pose.position);
    EXPECT_NEAR(std::hypot(off.x, off.z), 0, 1e-3);
  }
}

TEST(NamedStreetView, OnASquareLooksWhereThereIsMostToSee) {
  const scene::RenderScene scene = crossing();
  const auto view = scene::find_view_of(scene, scene.places.streets[2]);
  EXPECT_FALSE(view.from_above);
  EXPECT_LT(std::hypot(view.pose.position.x, view.pose.position.z), 30.1f);
  EXPECT_NEAR(view.pose.position.y, 1.7, 0.01);
}

TEST(NamedStreetView, IsFromAboveWhereNobodyCanStand) {
  const scene::RenderScene scene = crossing();
  for (const std::size_t i : {3u, 4u}) {
    const auto view = scene::find_view_of(scene, scene.places.streets[i]);
    EXPECT_TRUE(view.from_above);
    EXPECT_GT(view.pose.position.y, 50);
    EXPECT_NO_THROW(scene::make_camera(view.pose, 1.5f));
  }
  EXPECT_TRUE(scene::find_view_of(scene::RenderScene{}, scene.places.streets[0]).from_above);
}

TEST(NamedStreetView, WhatIsNotThereIsSaid) {
  const auto message_of = [](const scene::RenderScene& scene) -> std::string {
    try {
      scene::find_camera("street:Broadway", scene);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message_of(crossing()).find("none of 5 streets"), std::string::npos);
  EXPECT_NE(message_of(SceneBuilder().ground(10).with({})).find("no names of streets"),
            std::string::npos);
}

}  // namespace
}  // namespace nightcity::test
