#include "tools/citygml/compare_readers.h"

#include <gtest/gtest.h>

#include "support/data.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/citygml/temporary_file.h"

namespace nightcity::citygml {
namespace {

using namespace test;

TEST(CompareReaders, AgreeOnWhatBothUnderstand) {
  const ReaderComparison c = compare_readers(
      TemporaryFile(city_model(member(building("A")) + member(building("B")))).path(), 2);
  EXPECT_TRUE(c.agree());
  EXPECT_EQ(c.objects.at("building").first.objects, 2u);
  EXPECT_EQ(c.surfaces.at("wall").second.polygons, 2u);
  EXPECT_DOUBLE_EQ(c.surfaces.at("roof").first.area, 2.0);
}

TEST(CompareReaders, NameWhatOnlyOneHasRead) {
  const std::string footprint = "<bldg:Building gml:id=\"flat\"><bldg:lod0FootPrint>" +
                                multi_surface(surface_member(polygon("p", square_at_zero))) +
                                "</bldg:lod0FootPrint></bldg:Building>";
  const std::string zone =
      "<bldg:Building gml:id=\"odd\"><bldg:boundedBy><x:Party "
      "xmlns:x=\"x\"><x:y><x:z/></x:y></x:Party>"
      "</bldg:boundedBy></bldg:Building>";
  const ReaderComparison c = compare_readers(
      TemporaryFile(city_model(member(building("A")) + member(footprint) + member(zone))).path(),
      2);
  EXPECT_FALSE(c.agree());
  EXPECT_EQ(c.surfaces.at("ground").first.polygons, 2u);  // libcitygml skips lod0
  EXPECT_EQ(c.surfaces.at("ground").second.polygons, 1u);
}

TEST(CompareReaders, AgreeOnARealTile) {
  REAL_DATA(file, "berlin/3910_5819.gml");
  const ReaderComparison c = compare_readers(file, 2);
  EXPECT_TRUE(c.agree());
  EXPECT_EQ(c.stream.polygons, 1207u);
}

}  // namespace
}  // namespace nightcity::citygml
