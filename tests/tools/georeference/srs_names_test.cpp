#include "tools/georeference/srs_names.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace nightcity::georeference {
namespace {

bool offers(const char* name, const char* definition) {
  const auto all = list_crs_definitions(name);
  return std::find(all.begin(), all.end(), definition) != all.end();
}

TEST(SrsNames, GermanStateNamesBecomeTheirEpsgCodeFirst) {
  EXPECT_EQ(list_crs_definitions("urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH").front(), "EPSG:25832");
  EXPECT_EQ(list_crs_definitions("urn:adv:crs:ETRS89_UTM33*DE_DHHN92_NH").front(), "EPSG:25833");
  EXPECT_EQ(list_crs_definitions("urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016").front(),
            "EPSG:25832");
  EXPECT_EQ(list_crs_definitions("urn:adv:crs:DE_DHDN_3GK4*DE_DHN92_NH").front(), "EPSG:31468");
  EXPECT_EQ(list_crs_definitions("urn:adv:crs:DE_DHDN_3GK4_BY120").front(), "EPSG:31468");
}

TEST(SrsNames, HorizontalCodeOfACompoundIsOfferedAndTheVersionIsNoCode) {
  EXPECT_TRUE(offers("urn:ogc:def:crs,crs:EPSG:6.12:25833,crs:EPSG:6.12:5783", "EPSG:25833"));
  EXPECT_TRUE(offers("urn:ogc:def:crs,crs:EPSG::27700,crs:EPSG::5101", "EPSG:27700"));
  EXPECT_TRUE(offers("urn:ogc:def:crs,crs:EPSG::2180,crs:PL-EVRF2007-NH", "EPSG:2180"));
  EXPECT_TRUE(offers("http://www.opengis.net/gml/srs/epsg.xml#28992", "EPSG:28992"));
  EXPECT_TRUE(offers("EPSG::5514", "EPSG:5514"));
  EXPECT_TRUE(offers("EPSG:5514,EPSG:8357", "EPSG:5514"));
  EXPECT_FALSE(offers("EPSG:5514,EPSG:8357", "EPSG:8357"));
}

TEST(SrsNames, SwissNameMeansTheProjectedSystem) {
  EXPECT_EQ(list_crs_definitions("CH1903"), std::vector<std::string>{"EPSG:21781"});
  EXPECT_EQ(list_crs_definitions(" CH1903+ "), std::vector<std::string>{"EPSG:2056"});
}

TEST(SrsNames, ACodeAloneIsThatOfEpsgAndLongitudeComesFirstInCrs84) {
  EXPECT_EQ(list_crs_definitions("27700"), std::vector<std::string>{"EPSG:27700"});
  EXPECT_EQ(list_crs_definitions("25832").front(), "EPSG:25832");
  EXPECT_EQ(list_crs_definitions("CRS:84"), std::vector<std::string>{"OGC:CRS84"});
  EXPECT_EQ(list_crs_definitions("123").front(), "123");
}

TEST(SrsNames, TextsOfProjAreSystemsAndNoOperations) {
  const std::string utm = "+proj=utm +zone=33 +ellps=GRS80 +units=m +no_defs";
  EXPECT_EQ(list_crs_definitions(utm), std::vector<std::string>{utm + " +type=crs"});
  EXPECT_TRUE(offers("+init=epsg:25833", "EPSG:25833"));
  EXPECT_EQ(list_crs_definitions(utm + " +type=crs"), std::vector<std::string>{utm + " +type=crs"});
}

TEST(SrsNames, NoNameGivesNoDefinition) {
  EXPECT_TRUE(list_crs_definitions("").empty());
  EXPECT_TRUE(list_crs_definitions("  \n").empty());
}

TEST(SrsNames, OnlyUrnAndOpengisFormsPromiseTheRegistersAxisOrder) {
  EXPECT_EQ(find_axis_promise("urn:ogc:def:crs:EPSG::3879"), AxisPromise::fixed);
  EXPECT_EQ(find_axis_promise("urn:ogc:def:crs,crs:EPSG:6.12:25833,crs:EPSG:6.12:5783"),
            AxisPromise::fixed);
  // The second part names no authority: no URN, whatever it means.
  EXPECT_EQ(find_axis_promise("urn:ogc:def:crs,crs:EPSG::2180,crs:PL-EVRF2007-NH"),
            AxisPromise::register_order);
  EXPECT_EQ(find_axis_promise("http://www.opengis.net/def/crs/EPSG/0/6697"), AxisPromise::fixed);
  EXPECT_EQ(find_axis_promise("EPSG:3879"), AxisPromise::east_north);
  EXPECT_EQ(find_axis_promise("http://www.opengis.net/gml/srs/epsg.xml#28992"),
            AxisPromise::east_north);
}

}  // namespace
}  // namespace nightcity::georeference
