#include "tools/ground_cover/ground_kind.h"

#include <gtest/gtest.h>

#include "formats/material_names.h"

namespace nightcity::ground_cover {
namespace {

TEST(GroundKind, ReflectsWhatItsSourceSays) {
  struct Range {
    GroundKind kind;
    float low, high;
  };
  // Oke 1987, tables 1.1 and 8.2; plants by light, not by all of the sun's rays.
  for (const Range& range :
       {Range{GroundKind::asphalt, 0.08f, 0.12f}, Range{GroundKind::concrete, 0.10f, 0.35f},
        Range{GroundKind::paving_stones, 0.20f, 0.30f}, Range{GroundKind::sett, 0.20f, 0.35f},
        Range{GroundKind::sand, 0.20f, 0.45f}, Range{GroundKind::soil, 0.05f, 0.40f},
        Range{GroundKind::grass, 0.05f, 0.15f}, Range{GroundKind::woodland, 0.05f, 0.15f},
        Range{GroundKind::water, 0.03f, 0.10f}, Range{GroundKind::ice, 0.20f, 0.40f},
        Range{GroundKind::snow, 0.40f, 0.95f}}) {
    EXPECT_GE(find_material(range.kind).reflectance, range.low) << find_material(range.kind).name;
    EXPECT_LE(find_material(range.kind).reflectance, range.high) << find_material(range.kind).name;
  }
  EXPECT_EQ(ground_materials().size(), ground_kind_count);
}

// What a reader of the scene can tell from the names (formats/material_names.h).
TEST(GroundKind, CarriagewaysAreKnownByTheirMaterials) {
  for (const GroundKind kind :
       {GroundKind::asphalt, GroundKind::concrete, GroundKind::sett, GroundKind::paint})
    EXPECT_TRUE(is_carriageway_material(find_material(kind).name)) << find_material(kind).name;
  for (const GroundKind kind : {GroundKind::paving_stones, GroundKind::grass, GroundKind::kerb})
    EXPECT_FALSE(is_carriageway_material(find_material(kind).name)) << find_material(kind).name;
  EXPECT_TRUE(is_carriageway_material("road #804000"));
  EXPECT_TRUE(is_carriageway_material("road picture 3"));
  EXPECT_FALSE(is_carriageway_material("roadside"));
  EXPECT_FALSE(is_carriageway_material("wall concrete 2"));
  EXPECT_FALSE(is_carriageway_material(""));
}

TEST(GroundKind, ReadsSurfacesAsPeopleWriteThem) {
  EXPECT_EQ(find_surface("asphalt"), GroundKind::asphalt);
  EXPECT_EQ(find_surface(" Paving-Stones "), GroundKind::paving_stones);
  EXPECT_EQ(find_surface("concrete:plates"), GroundKind::concrete);
  EXPECT_EQ(find_surface("sett;asphalt"), GroundKind::sett);
  EXPECT_EQ(find_surface("paving_stones:30"), GroundKind::paving_stones);
  EXPECT_EQ(find_surface("cobblestone:10"), GroundKind::sett);
  EXPECT_EQ(find_surface("pebbles"), GroundKind::gravel);
  EXPECT_EQ(find_surface("tiles"), GroundKind::paving_stones);
  EXPECT_FALSE(find_surface(":30"));
  EXPECT_FALSE(find_surface("lava"));
  EXPECT_FALSE(find_surface(""));
  EXPECT_FALSE(find_surface(";"));
}

}  // namespace
}  // namespace nightcity::ground_cover
