#include "tools/barriers/barrier_kind.h"

#include <gtest/gtest.h>

#include <set>

namespace nightcity::barriers {
namespace {

std::optional<BarrierDesign> design_of(const osm::OsmTags& tags) {
  const char* reason = nullptr;
  const auto design = read_design(tags, reason);
  EXPECT_EQ(reason == nullptr, design.has_value()) << "what is not drawn has a reason";
  return design;
}

TEST(BarrierKind, TagsSayHowLargeABarrierIs) {
  const auto wall = design_of({{"barrier", "wall"}, {"height", "3 m"}, {"width", "40 cm"}});
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->kind.height_m, 3);
  EXPECT_NEAR(wall->kind.width_m, 0.4, 1e-12);
  EXPECT_FALSE(wall->assumed_height || wall->assumed_width);
  EXPECT_TRUE(wall->assumed_material);
}

TEST(BarrierKind, SizesThatSayNonsenseAreAssumed) {
  for (const char* text : {"1e9", "-2", "nan", "inf", "0", "1000000", "high", ""}) {
    const auto wall = design_of({{"barrier", "wall"}, {"height", text}, {"width", text}});
    ASSERT_TRUE(wall);
    // "1e9" begins as a number whose unit is unknown.
    EXPECT_TRUE(wall->assumed_height && wall->assumed_width) << text;
    EXPECT_EQ(wall->kind.height_m, 2);
  }
}

TEST(BarrierKind, TagsSayWhatABarrierIsMadeOf) {
  const auto material_of = [](const osm::OsmTags& tags) { return design_of(tags)->kind.material; };
  EXPECT_EQ(material_of({{"barrier", "wall"}, {"wall", "brick"}}), BarrierMaterial::brick);
  EXPECT_EQ(material_of({{"barrier", "wall"}, {"material", "Concrete"}}),
            BarrierMaterial::concrete);
  EXPECT_EQ(material_of({{"barrier", "hedge"}, {"material", "concrete"}}),
            BarrierMaterial::foliage);
  EXPECT_EQ(material_of({{"barrier", "fence"}, {"fence_type", "wood"}}), BarrierMaterial::wood);
  EXPECT_EQ(material_of({{"barrier", "fence"}, {"fence_type", "?"}, {"material", "wood"}}),
            BarrierMaterial::wood);
}

TEST(BarrierKind, WhatIsNotDrawnHasAReason) {
  for (const char* value : {"kerb", "bollard", "chain", "handrail", "gate", "lift_gate", "yes"})
    EXPECT_FALSE(design_of({{"barrier", value}})) << value;
  EXPECT_FALSE(design_of({{"barrier", "fence"}, {"fence_type", "barbed_wire"}}));
  EXPECT_FALSE(design_of({{"barrier", "wall"}, {"indoor", "yes"}}));
  EXPECT_FALSE(design_of({{"barrier", "wall"}, {"level", "-1"}}));
  EXPECT_FALSE(design_of({{"barrier", "wall"}, {"layer", "-1"}}));
  EXPECT_FALSE(design_of({{"barrier", "wall"}, {"tunnel", "yes"}}));
  EXPECT_TRUE(design_of({{"barrier", "wall"}, {"level", "0"}, {"tunnel", "no"}}));
}

TEST(BarrierKind, EveryRowIsPhysical) {
  bool sheets_began = false;
  for (const BarrierKind& kind : barrier_kinds()) {
    EXPECT_GT(kind.height_m, 0);
    EXPECT_GE(kind.width_m, 0);
    EXPECT_GE(kind.gap, 0);
    EXPECT_LT(kind.gap, 1);
    EXPECT_TRUE(kind.gap == 0 || kind.width_m == 0) << "a box has no gaps";
    sheets_began |= kind.width_m == 0;
    EXPECT_EQ(sheets_began, kind.width_m == 0) << "solid ones come first";
  }
  std::set<std::string> names;
  for (std::size_t n = 0; n < barrier_material_count; ++n) {
    const MaterialRow& row = find_material(static_cast<BarrierMaterial>(n));
    EXPECT_GT(row.reflectance, 0);
    EXPECT_LT(row.reflectance, 1);
    EXPECT_TRUE(names.insert(row.name).second);
  }
}

TEST(BarrierKind, OfSeveralKindsTheFirstThatIsDrawnCounts) {
  const auto design = design_of({{"barrier", "gate;wall;fence"}, {"height", "2.2"}});
  ASSERT_TRUE(design);
  EXPECT_EQ(design->kind.value, "wall");
  EXPECT_EQ(design->kind.height_m, 2.2);
  EXPECT_EQ(design_of({{"barrier", "hedge"}, {"est_height", "3"}})->kind.height_m, 3);
  EXPECT_FALSE(design_of({{"barrier", "gate;ditch"}}));
}

}  // namespace
}  // namespace nightcity::barriers
