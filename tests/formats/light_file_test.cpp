#include "formats/light_file.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <cmath>
#include <cstring>
#include <glm/ext/scalar_constants.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "formats/error.h"
#include "formats/light_check.h"
#include "formats/light_file_edit.h"
#include "formats/light_file_writer.h"
#include "formats/rgb9e5.h"
#include "formats/scene_identity.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

using test::TempFolder;

Light lamp_at(float x) {
  return {{x, 8, 0},
          0.1f,
          {0, -1, 0},
          0,
          {1, 0, 0},
          5000,
          encode_rgb9e5({1.2f, 1, 0.6f}),
          pack_kind_profile(LightKind::sphere, LIGHT_NO_PROFILE),
          LIGHT_ALWAYS_ON,
          17};
}

Light vehicle_light(uint condition) {
  Light light = lamp_at(2.2f);
  light.schedule = condition;
  light.id = static_cast<uint>(LightFamily::tail_lamp);
  return light;
}

TripKnot knot(float time_s) {
  return {{time_s * 10, 0, 5}, time_s, {10, 0, 0}, 0};
}

struct Sample {
  std::vector<Light> lights{lamp_at(1), lamp_at(2), lamp_at(3)};
  std::vector<LightProvenance> provenance{3};
  std::vector<LightProfile> profiles{{1, 2, 0, 180}, {2, 3, 2, 45}};
  // Two values of the first profile, six of the second; the integral of each is 1.
  std::vector<float> data{0.05f,     0.109155f, 0.142274f, 0.284548f,
                          0.426822f, 0.569095f, 0.711369f, 0.853643f};
  std::vector<Schedule> schedules{{0, 3}, {3, 0}, {3, 1}};
  std::vector<uint> switches{18'000, 40'000, 61'200, 0};
  TrafficCycle cycle{600, 0, {0.5f, 1, 0.25f}};
  std::vector<VehicleKind> vehicles{{{2.2f, 0.7f, 0.9f}, 0, 2, {}}};
  std::vector<Light> vehicle_lights{vehicle_light(VEHICLE_LIGHT_ALWAYS),
                                    vehicle_light(VEHICLE_LIGHT_BRAKING)};
  std::vector<Trip> trips{{0, 2, 599, 0.5f, 0, 7, {}}, {2, 3, 0, 0, 0, 8, {}}};
  std::vector<TripKnot> knots{knot(0), knot(10), knot(0), knot(10), knot(600)};

  LightFileContent content() const {
    return {{"EPSG:25833", {391000.5, 5819000.25, 34}, {"a.osm"}, {"ODbL 1.0"}},
            lights,
            provenance,
            profiles,
            data,
            schedules,
            switches,
            {cycle, vehicles, vehicle_lights, trips, knots}};
  }
};

TEST(LightFileWriter, LightsAddedOneByOneMakeTheSameFile) {
  const TempFolder folder;
  const Sample sample;
  write_light_file(folder / "whole.lights", sample.content());
  LightFileWriter writer(folder / "streamed.lights");
  for (std::uint32_t n = 0; n < 2; ++n)
    EXPECT_EQ(writer.add(sample.lights[n], sample.provenance[n]), n);
  LightFileContent rest = sample.content();
  rest.lights = rest.lights.subspan(2);
  rest.provenance = rest.provenance.subspan(2);
  writer.finish(rest);
  LightFile::open(folder / "streamed.lights").verify();
  EXPECT_EQ(test::read_text(folder / "streamed.lights"), test::read_text(folder / "whole.lights"));
}

TEST(LightFileWriter, SchedulesAddedOneByOneComeBeforeTheOthers) {
  const TempFolder folder;
  Sample sample;
  {
    LightFileWriter writer(folder / "a.lights");
    EXPECT_EQ(writer.add_schedule(std::vector<uint>{18000, 36000}), 0u);
    EXPECT_EQ(writer.add_schedule({}), 1u);
    EXPECT_EQ(writer.add_schedule(std::vector<uint>{100, 200, 86399}), 2u);
    EXPECT_THROW(writer.add_schedule(std::vector<uint>{200, 100}), Error);
    EXPECT_THROW(writer.add_schedule(std::vector<uint>{86400}), Error);
    writer.finish(sample.content());
  }
  const LightFile file = LightFile::open(folder / "a.lights");
  file.verify();
  ASSERT_EQ(file.schedules().size(), 3 + sample.schedules.size());
  EXPECT_EQ(file.schedules()[2].first, 2u);
  EXPECT_EQ(file.schedules()[2].count, 3u);
  EXPECT_EQ(file.switches()[4], 86399u);
  for (std::size_t n = 0; n < sample.schedules.size(); ++n) {
    EXPECT_EQ(file.schedules()[3 + n].first, 5 + sample.schedules[n].first);
    EXPECT_EQ(file.schedules()[3 + n].count, sample.schedules[n].count);
  }
  EXPECT_EQ(file.switches().size(), 5 + sample.switches.size());
}

// A kind that is counted but not named, or named but not counted, would be
// taken for another somewhere.
TEST(LightKind, EveryKindThatIsCountedHasANameAndNoOther) {
  for (uint kind = 0; kind < LIGHT_KIND_COUNT; ++kind)
    EXPECT_STRNE(name_of(LightKind(kind)), "unknown") << kind;
  EXPECT_STREQ(name_of(LightKind(LIGHT_KIND_COUNT)), "unknown");
}

TEST(LightKind, KindAndProfileSurviveTheirPacking) {
  for (const uint profile : {0u, 77u, LIGHT_NO_PROFILE})
    for (const LightKind kind : {LightKind::sphere, LightKind::rectangle}) {
      Light light{};
      light.kind_profile = pack_kind_profile(kind, profile);
      EXPECT_EQ(light_kind(light), kind);
      EXPECT_EQ(light_profile(light), profile);
    }
}

TEST(LightFileWriter, RefusesInvalidLightsAndLeavesNothing) {
  const TempFolder folder;
  const Sample sample;
  {
    LightFileWriter writer(folder / "a.lights");
    Light dark = sample.lights[0];
    dark.flux_lm = 0;
    EXPECT_THROW(writer.add(dark, {}), Error);
  }
  for (const bool profile : {true, false}) {
    LightFileWriter writer(folder / "b.lights");
    Light light = sample.lights[0];
    if (profile)
      light.kind_profile = pack_kind_profile(LightKind::sphere,
                                             2);  // the sample has two profiles and three schedules
    else
      light.schedule = 3;
    writer.add(light, {});
    EXPECT_THROW(writer.finish(sample.content()), Error);
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(LightFile, KeepsEveryByte) {
  const TempFolder folder;
  Sample sample;
  sample.lights[1].kind_profile = pack_kind_profile(LightKind::rectangle, 1);
  sample.lights[1].half_height = 0.7f;
  sample.provenance[2] = {123456789012,
                          ValueSource::tag,
                          ValueSource::rule,
                          ValueSource::standard,
                          ValueSource::rule,
                          ValueSource::unknown,
                          ValueSource::attribute,
                          1,
                          0};
  write_light_file(folder / "city.lights", sample.content());
  const LightFile file = LightFile::open(folder / "city.lights");
  file.verify();
  EXPECT_EQ(file.georeference().crs, "EPSG:25833");
  EXPECT_EQ(file.georeference().origin, glm::dvec3(391000.5, 5819000.25, 34));
  EXPECT_EQ(file.georeference().licences, std::vector<std::string>{"ODbL 1.0"});
  ASSERT_EQ(file.lights().size(), 3u);
  EXPECT_EQ(std::memcmp(file.lights().data(), sample.lights.data(), 3 * sizeof(Light)), 0);
  EXPECT_EQ(
      std::memcmp(file.provenance().data(), sample.provenance.data(), 3 * sizeof(LightProvenance)),
      0);
  EXPECT_EQ(std::memcmp(file.profiles().data(), sample.profiles.data(), 2 * sizeof(LightProfile)),
            0);
  EXPECT_EQ(std::vector<float>(file.profile_data().begin(), file.profile_data().end()),
            sample.data);
  const auto same = [](auto read, const auto& written) {
    return read.size() == written.size() &&
           std::memcmp(read.data(), written.data(), written.size() * sizeof(written[0])) == 0;
  };
  EXPECT_TRUE(same(file.schedules(), sample.schedules));
  EXPECT_TRUE(same(file.switches(), sample.switches));
  const TrafficCycle cycle = file.traffic().cycle;
  EXPECT_EQ(std::memcmp(&cycle, &sample.cycle, sizeof cycle), 0);
  EXPECT_TRUE(same(file.traffic().vehicles, sample.vehicles));
  EXPECT_TRUE(same(file.traffic().vehicle_lights, sample.vehicle_lights));
  EXPECT_TRUE(same(file.traffic().trips, sample.trips));
  EXPECT_TRUE(same(file.traffic().knots, sample.knots));
}

TEST(LightFile, MayHoldNoLights) {
  const TempFolder folder;
  write_light_file(folder / "city.lights", {});
  const LightFile file = LightFile::open(folder / "city.lights");
  file.verify();
  EXPECT_TRUE(file.lights().empty());
}

TEST(LightFile, WriterRefusesUnphysicalLightsAndLeavesNothing) {
  const TempFolder folder;
  const auto refused = [&](auto&& spoil) {
    Sample sample;
    spoil(sample);
    EXPECT_THROW(write_light_file(folder / "city.lights", sample.content()), Error);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  refused([&](Sample& s) { s.lights[1].flux_lm = 0; });
  refused([&](Sample& s) { s.lights[1].flux_lm = -5; });
  refused([&](Sample& s) { s.lights[1].flux_lm = nan; });
  refused([&](Sample& s) { s.lights[1].flux_lm = inf; });
  refused([&](Sample& s) { s.lights[1].position.z = nan; });
  refused([&](Sample& s) { s.lights[1].radius = -1; });
  refused([&](Sample& s) { s.lights[1].axis = {0, -2, 0}; });
  refused([&](Sample& s) { s.lights[1].axis = {0, nan, 0}; });
  refused([&](Sample& s) { s.lights[1].tangent = {0, 1, 0}; });  // along the axis
  refused([&](Sample& s) { s.lights[1].colour_rgb9e5 = 0; });
  refused([&](Sample& s) { s.lights[1].kind_profile = 9; });
  refused([&](Sample& s) {
    s.lights[1].kind_profile = pack_kind_profile(LightKind::sphere, 2);
  });  // no such profile
  refused([&](Sample& s) {
    s.lights[1].kind_profile = pack_kind_profile(LightKind::rectangle, LIGHT_NO_PROFILE);
  });  // no area
  refused([&](Sample& s) { s.profiles[1].data_offset = 3; });
  refused([&](Sample& s) { s.profiles[1].gamma_count = 0xFFFFFFFFu; });
  refused([&](Sample& s) { s.profiles[1].extent_deg = 0; });
  refused([&](Sample& s) { s.profiles[1].extent_deg = nan; });
  refused([&](Sample& s) { s.lights[1].schedule = 3; });  // no such schedule
  refused([&](Sample& s) { s.schedules[1].count = 9; });
  refused([&](Sample& s) { s.switches[1] = s.switches[0]; });
  refused([&](Sample& s) { s.switches[2] = 86'400; });
  refused([&](Sample& s) { s.cycle.cycle_s = 0; });
  refused([&](Sample& s) { s.cycle.density[23] = nan; });
  refused([&](Sample& s) { s.vehicles[0].half_size.y = 0; });
  refused([&](Sample& s) { s.vehicles[0].first_light = 1; });
  refused([&](Sample& s) { s.vehicle_lights[0].schedule = LIGHT_ALWAYS_ON; });
  refused([&](Sample& s) { s.vehicle_lights[0].flux_lm = 0; });
  refused([&](Sample& s) { s.trips[1].vehicle = 1; });
  refused([&](Sample& s) { s.trips[1].start_s = 600; });
  refused([&](Sample& s) { s.trips[1].rank = 1; });
  refused([&](Sample& s) { s.trips[1].knot_count = 1; });
  refused([&](Sample& s) { s.trips[1].first_knot = 3; });
  refused([&](Sample& s) { s.knots[4].time_s = 601; });
  refused([&](Sample& s) { s.knots[3].time_s = 0; });
  refused([&](Sample& s) { s.knots[3].velocity.x = inf; });
  refused([&](Sample& s) { s.knots[3].position.y = 1e16f; });
  refused([&](Sample& s) { s.data[3] = -1; });
  refused([&](Sample& s) { s.data[3] = inf; });
  refused([&](Sample& s) { s.data[1] *= 2; });  // an integral that is not 1
  refused([&](Sample& s) { s.lights[1].flux_lm = 1e-40f; });
  refused([&](Sample& s) { s.vehicle_lights[1].flux_lm = 1e-31f; });
  refused([&](Sample& s) { s.lights[1].tangent = {0.1f, -0.995f, 0}; });  // not perpendicular
  refused([&](Sample& s) { s.provenance.pop_back(); });
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(LightFile, RefusesTheFileCutOffAtAnyByte) {
  const TempFolder folder;
  write_light_file(folder / "whole", Sample().content());
  const std::string whole = test::read_text(folder / "whole");
  for (std::size_t length = 0; length < whole.size(); length += 3) {
    test::write_text(folder / "cut", std::string_view(whole).substr(0, length));
    EXPECT_THROW(LightFile::open(folder / "cut"), Error) << length;
  }
}

TEST(LightFile, FindsEveryChangedByte) {
  const TempFolder folder;
  write_light_file(folder / "whole", Sample().content());
  const std::string whole = test::read_text(folder / "whole");
  std::size_t padding = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x40);
    test::write_text(folder / "changed", changed);
    try {
      LightFile::open(folder / "changed").verify();
      ++padding;  // no checksum covers the zero bytes between sections
    } catch (const Error&) {
    }
  }
  EXPECT_LT(padding, 13u * 64u);
}

// Adds a section to the table, as a later version of the format might.
// SPEC.md describes the layout.
std::string with_section(std::string bytes, const char* tag) {
  const auto put = [&bytes](std::size_t at, std::uint64_t value) {
    std::memcpy(&bytes[at], &value, 8);
  };
  std::uint64_t table = 0;
  std::memcpy(&table, &bytes[24], 8);
  std::string entry(32, '\0');
  std::memcpy(entry.data(), tag, 4);
  entry[4] = 1;  // element size; offset 0, no elements
  const std::uint64_t nothing = XXH64(nullptr, 0, 0);
  std::memcpy(&entry[24], &nothing, 8);
  bytes += entry;
  ++bytes[12];  // section count
  put(16, bytes.size());
  put(32, XXH64(&bytes[table], bytes.size() - table, 0));
  put(56, XXH64(bytes.data(), 56, 0));
  return bytes;
}

TEST(LightFile, SkipsSectionsItDoesNotKnowButRefusesOneTwice) {
  const TempFolder folder;
  write_light_file(folder / "city.lights", Sample().content());
  const std::string bytes = test::read_text(folder / "city.lights");
  test::write_text(folder / "later", with_section(bytes, "XXXX"));
  const LightFile later = LightFile::open(folder / "later");
  later.verify();
  EXPECT_EQ(later.lights().size(), 3u);
  test::write_text(folder / "twice", with_section(bytes, "LGHT"));
  EXPECT_THROW(LightFile::open(folder / "twice"), Error);
}

TEST(LightFile, SaysWhatIsWrongWithAFileOfAnotherKind) {
  const TempFolder folder;
  const auto message = [&](std::string_view content) -> std::string {
    test::write_text(folder / "file", content);
    try {
      LightFile::open(folder / "file");
    } catch (const Error& error) {
      return error.what();
    }
    return "opened";
  };
  EXPECT_NE(message("").find("is empty"), std::string::npos);
  EXPECT_NE(message("<osm/>").find("is not a light file"), std::string::npos);
  EXPECT_NE(message(std::string(1000, 'x')).find("is not a light file"), std::string::npos);
  EXPECT_THROW(LightFile::open(folder / "absent"), Error);
  EXPECT_THROW(LightFile::open(folder.path()), Error);
}

TEST(LightProfile, ItsIntegralIsThatOfTheBilinearInterpolant) {
  // Without a profile: 1 / (4 pi) in every direction.
  const float uniform = 0.0795774715f;
  const std::vector<float> isotropic(6, uniform);
  EXPECT_NEAR(integrate_profile({1, 6, 0, 180}, isotropic), 1, 1e-6);
  EXPECT_NEAR(integrate_profile({3, 2, 0, 180}, isotropic), 1, 1e-6);
  EXPECT_NEAR(integrate_profile({3, 2, 0, 90}, isotropic), 0.5, 1e-6);  // dark beyond
  // 2 pi times the integral of (1 - gamma / pi) sin(gamma) is 2 pi.
  EXPECT_NEAR(integrate_profile({1, 2, 0, 180}, std::vector<float>{1, 0}), 6.283185, 1e-5);
  // The mean over C counts: 0 in one plane of two is half.
  EXPECT_NEAR(integrate_profile({2, 2, 0, 180}, std::vector<float>{1, 1, 0, 0}), 6.283185, 1e-5);
  std::vector<float> near_one(2, uniform * 1.004f);
  EXPECT_FALSE(profile_integral_fault({1, 2, 0, 180}, near_one));
  near_one.assign(2, uniform * 1.006f);
  EXPECT_TRUE(profile_integral_fault({1, 2, 0, 180}, near_one));
  // Beams of one intensity, down to a hundred-millionth of a degree.
  for (const float extent : {180.f, 1.f, 1e-2f, 1e-4f, 1e-6f, 1e-8f}) {
    const double half = glm::radians(double{extent}) / 2;
    const auto density =
        static_cast<float>(1 / (4 * glm::pi<double>() * std::sin(half) * std::sin(half)));
    EXPECT_NEAR(integrate_profile({1, 2, 0, extent}, std::vector<float>(2, density)), 1, 1e-6);
    EXPECT_NEAR(integrate_profile({1, 5, 0, extent}, std::vector<float>(5, density)), 1, 1e-6);
  }
}

TEST(SceneIdentity, LightsOfAnotherSceneAreRefusedWithBothNames) {
  Georeference one{"EPSG:25833", {1, 2, 3}, {"a.osm"}, {}}, other = one;
  EXPECT_NO_THROW(require_same_scene("a.glb", one, "a.lights", other));  // neither says
  one.scene_id = make_scene_id(one, 1);
  EXPECT_NO_THROW(require_same_scene("a.glb", one, "a.lights", other));
  EXPECT_EQ(one.scene_id.size(), 16u);
  EXPECT_EQ(make_scene_id(one, 1), one.scene_id);  // the id is no part of what it is made of
  other.scene_id = make_scene_id(other, 2);
  EXPECT_NE(other.scene_id, one.scene_id);
  try {
    require_same_scene("a.glb", one, "b.lights", other);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.glb"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("b.lights"), std::string::npos);
  }
}

TEST(SceneIdentity, TheLightFileKeepsIt) {
  const TempFolder folder;
  const Sample sample;
  LightFileContent content = sample.content();
  {
    LightFileWriter writer(folder / "a.lights");
    for (std::size_t i = 0; i < 3; ++i) writer.add(sample.lights[i], sample.provenance[i]);
    content.georeference.scene_id = writer.scene_id(content.georeference);
    content.lights = {};
    content.provenance = {};
    writer.finish(content);
  }
  const LightFile file = LightFile::open(folder / "a.lights");
  EXPECT_EQ(file.georeference().scene_id, content.georeference.scene_id);
  EXPECT_EQ(to_content(file).georeference.scene_id, content.georeference.scene_id);
}

TEST(Rgb9e5, KeepsColoursToNineBits) {
  for (const glm::vec3 colour :
       {glm::vec3(1, 1, 1), glm::vec3(3.1f, 0.9f, 0.01f), glm::vec3(1e-3f, 2e-4f, 0),
        glm::vec3(511.9f, 3, 4), glm::vec3(65000, 1, 0), glm::vec3(0.99999f, 0.5f, 0.25f)}) {
    const glm::vec3 back = decode_rgb9e5(encode_rgb9e5(colour));
    const float largest = std::max({colour.x, colour.y, colour.z});
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], colour[i], largest / 511) << largest;
  }
  EXPECT_EQ(encode_rgb9e5({0, 0, 0}), 0u);
  EXPECT_EQ(encode_rgb9e5({-1, std::nanf(""), 0}), 0u);
  EXPECT_EQ(decode_rgb9e5(encode_rgb9e5({1e9f, 0, 0})).x, 65408.0f);
  EXPECT_EQ(encode_rgb9e5({1, 1, 1}),
            0x84020100u);  // by the extension's layout: mantissas 256, exponent 16
}

TEST(LightFileEdit, ContentIsAllThatTheFileHolds) {
  const TempFolder folder;
  write_light_file(folder / "a.lights", Sample().content());
  const LightFile file = LightFile::open(folder / "a.lights");
  write_light_file(folder / "b.lights", to_content(file));
  EXPECT_EQ(test::read_text(folder / "b.lights"), test::read_text(folder / "a.lights"));
}

TEST(LightFileEdit, TrafficTakesThePlaceOfTheOldAndItsProfilesFollowTheOthers) {
  const TempFolder folder;
  write_light_file(folder / "a.lights", Sample().content());
  Sample added;
  added.vehicle_lights[1].kind_profile = LIGHT_SPHERE | 1u << 8;
  added.trips.pop_back();
  added.knots.resize(2);
  {
    const LightFile file = LightFile::open(folder / "a.lights");
    write_with_traffic(folder / "a.lights", to_content(file),
                       {added.content().traffic, added.profiles, added.data});
  }
  const LightFile file = LightFile::open(folder / "a.lights");
  file.verify();
  EXPECT_EQ(file.lights().size(), 3u);
  ASSERT_EQ(file.profiles().size(), 4u);
  EXPECT_EQ(file.profiles()[3].data_offset, 8u + added.profiles[1].data_offset);
  EXPECT_EQ(file.profile_data().size(), 16u);
  EXPECT_EQ(file.traffic().trips.size(), 1u);
  ASSERT_EQ(file.traffic().vehicle_lights.size(), 2u);
  EXPECT_EQ(light_profile(file.traffic().vehicle_lights[1]), 3u);
}

TEST(LightFileEdit, TrafficWithoutATripLeavesNone) {
  const TempFolder folder;
  const Sample sample;
  write_with_traffic(folder / "a.lights", sample.content(), {});
  const LightFile file = LightFile::open(folder / "a.lights");
  file.verify();
  EXPECT_TRUE(file.traffic().trips.empty());
  EXPECT_TRUE(file.traffic().vehicles.empty());
  EXPECT_EQ(file.profiles().size(), 2u);
}

}  // namespace
}  // namespace nightcity
