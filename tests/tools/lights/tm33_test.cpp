// ANSI/IES TM-33 in XML, of 2018 and 2022: the flux is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "formats/error.h"
#include "support/temp_folder.h"
#include "tools/lights/luminaire.h"

namespace nightcity::lights {
namespace {

using std::numbers::pi;

using Candela = std::function<double(double h, double v)>;

double hundred(double, double) {
  return 100;
}
constexpr double half_space_lm = 200 * pi;  // 100 cd over half of the sphere

std::vector<double> every(double step, double from, double to) {
  std::vector<double> angles;
  for (double angle = from; angle <= to; angle += step) angles.push_back(angle);
  return angles;
}

std::string list_points(const std::vector<double>& h, const std::vector<double>& v,
                        const Candela& candela, const std::string& element = "IntData",
                        const std::string& h_name = "h", const std::string& v_name = "v") {
  std::string text;
  for (const double vertical : v)
    for (const double horizontal : h)
      text += "<" + element + " " + h_name + "=\"" + std::to_string(horizontal) + "\" " + v_name +
              "=\"" + std::to_string(vertical) + "\">" +
              std::to_string(candela(horizontal, vertical)) + "</" + element + ">\n";
  return text;
}

std::string emitter_2022(const std::string& points, const std::string& head = {}) {
  return "<Emitter><Quantity>1</Quantity><RatedLumens>900</RatedLumens><LuminousData>" + head +
         points + "</LuminousData></Emitter>";
}

std::string document_2022(const std::string& emitters) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<IESTM33-22><Version>1.1</Version>"
         "<Header><Manufacturer>M\xc3\xbcller</Manufacturer><Description>Probe</Description>"
         "</Header>" +
         emitters + "</IESTM33-22>\n";
}

Luminaire read_text(const std::string& text) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder.path() / "a.xml";
  std::ofstream(file, std::ios::binary) << text;
  return read_luminaire(file);
}

std::string error_of_text(const std::string& text) {
  try {
    read_text(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

const std::vector<double> down = every(10, 0, 90), whole_turn{0}, quarter{0, 45, 90};

TEST(Tm33, TheEditionOf2022) {
  const Luminaire luminaire = read_text(document_2022(emitter_2022(
      list_points(quarter, down, hundred),
      "<PhotometryType>CIE _ C</PhotometryType><Metric>Luminous</Metric><SymmType>Symm _ "
      "Quad</SymmType><Multiplier>2</Multiplier>")));
  EXPECT_NEAR(luminaire.flux_lm, 2 * half_space_lm, 1e-6);
  EXPECT_EQ(luminaire.manufacturer, "M\xc3\xbcller");
  EXPECT_EQ(luminaire.name, "Probe");
  EXPECT_EQ(luminaire.stated_flux_lm, 900);
}

TEST(Tm33, TheEditionOf2018) {
  const std::string text =
      "<LuminaireOpticalData version=\"1.0\" xmlns=\"http://www.ies.org/tm-33\"><Header>"
      "<CatalogNumber>N1</CatalogNumber></Header><Emitter><IntensityDistribution>"
      "<PhotometryType>C</PhotometryType>" +
      list_points(whole_turn, down, hundred, "IntensityData", "horz", "vert") +
      "</IntensityDistribution></Emitter></LuminaireOpticalData>";
  const Luminaire luminaire = read_text(text);
  EXPECT_NEAR(luminaire.flux_lm, half_space_lm, 1e-6);
  EXPECT_EQ(luminaire.name, "N1");
}

TEST(Tm33, ALambertianSourceGivesPiTimesItsPeak) {
  const auto lambert = [](double, double v) { return 1000 / pi * std::cos(v * pi / 180); };
  const Luminaire luminaire =
      read_text(document_2022(emitter_2022(list_points(whole_turn, every(1, 0, 90), lambert))));
  EXPECT_NEAR(luminaire.flux_lm, 1000, 0.2);
}

// To look for the line of each point from the beginning would take minutes.
TEST(Tm33, ADegreeInAllDirectionsIsRead) {
  const Luminaire luminaire = read_text(
      document_2022(emitter_2022(list_points(every(1, 0, 360), every(1, 0, 180), hundred))));
  EXPECT_NEAR(luminaire.flux_lm, 2 * half_space_lm, 1e-6);
}

TEST(Tm33, PlanesAreUnfoldedByTheSectorThatTheyList) {
  // 90 to 270 degrees: bright to the sides at 90 and 270, dark at 180.
  const auto sides = [](double h, double) { return 100 * std::abs(std::sin(h * pi / 180)); };
  const Luminaire luminaire =
      read_text(document_2022(emitter_2022(list_points({90, 180, 270}, down, sides))));
  EXPECT_NEAR(intensity_at(luminaire.grid, 90, 45), 100, 1e-3);
  EXPECT_NEAR(intensity_at(luminaire.grid, 0, 45), 0, 1e-3);
  EXPECT_NEAR(intensity_at(luminaire.grid, 180, 45), 0, 1e-3);
  const std::vector<double> half_turn{-90, -45, 0, 45, 90};
  EXPECT_NEAR(read_text(document_2022(emitter_2022(list_points(half_turn, half_turn, hundred),
                                                   "<PhotometryType>CIE-B</PhotometryType>")))
                  .flux_lm,
              half_space_lm, 0.01 * half_space_lm);
}

TEST(Tm33, EmittersGiveTheirLightTogether) {
  const std::string one = emitter_2022(list_points(whole_turn, down, hundred));
  const std::string dark = "<Emitter><Quantity>1</Quantity></Emitter>";
  const Luminaire both = read_text(document_2022(one + dark + one));
  EXPECT_NEAR(both.flux_lm, 2 * half_space_lm, 1e-6);
  EXPECT_EQ(both.stated_flux_lm, 1800);
  EXPECT_TRUE(both.notes.empty());
  const std::string other = emitter_2022(list_points(whole_turn, every(15, 0, 90), hundred));
  EXPECT_NE(error_of_text(document_2022(one + other)).find("different angles"), std::string::npos);
  std::string four = one;
  four.replace(four.find("<Quantity>1"), 11, "<Quantity>4");
  EXPECT_EQ(read_text(document_2022(four)).notes.size(), 1u);
}

// In the schema of the standard candela are in LuminousIntensity, watts beside it, and the type is
// at the device that measured.
TEST(Tm33, TheStandardsOwnSchemaIsRead) {
  const std::string points = list_points(whole_turn, down, hundred);
  const std::string watts = "<RadiantData><RadiantIntensity>" +
                            list_points(whole_turn, down, [](double, double) { return 7.0; }) +
                            "</RadiantIntensity></RadiantData>";
  const Luminaire luminaire = read_text(document_2022(
      "<Emitter><Quantity>1</Quantity>" + watts +
      "<LuminousData><LuminousIntensity><Multiplier>3</Multiplier><NumberHorz>1</NumberHorz>" +
      points + "</LuminousIntensity><LuminousFlux>9</LuminousFlux></LuminousData></Emitter>"));
  EXPECT_NEAR(luminaire.flux_lm, 3 * half_space_lm, 1e-6);
  EXPECT_NE(error_of_text(document_2022("<Emitter>" + watts + "</Emitter>"))
                .find("lists its intensities"),
            std::string::npos);
  const std::vector<double> half_turn{-90, -45, 0, 45, 90};
  EXPECT_NEAR(
      read_text(document_2022(
                    "<Equipment><Gonioradiometer><Type>IES _ B</Type></Gonioradiometer></Equipment>"
                    "<Emitter><LuminousData><LuminousIntensity>" +
                    list_points(half_turn, half_turn, hundred) +
                    "</LuminousIntensity></LuminousData></Emitter>"))
          .flux_lm,
      half_space_lm, 0.01 * half_space_lm);
}

// The box round all luminous areas, in metres of millimetres, as LM-63 has it.
TEST(Tm33, TheLuminousOpeningIsTheBoxRoundItsAreas) {
  const auto read_areas = [](const std::string& areas, const std::string& centre = {}) {
    return read_text(document_2022(
        "<Emitter><LuminousData>" + list_points(whole_turn, down, hundred) +
        "</LuminousData><EmissionAreas>" + areas + "</EmissionAreas>" + centre + "</Emitter>"));
  };
  const auto bottom = [](const char* length, const char* width, const char* along,
                         const char* extra = "") {
    return std::string("<BottomArea><Length>") + length + "</Length><Width>" + width +
           "</Width><LengthOffset>" + along + "</LengthOffset><WidthOffset>0</WidthOffset>" +
           extra + "</BottomArea>";
  };
  const Luminaire one = read_areas("<BottomFace><NumberBottom>1</NumberBottom>" +
                                   bottom("600", "150", "0") + "</BottomFace>");
  EXPECT_NEAR(one.length_m, 0.6, 1e-12);
  EXPECT_NEAR(one.width_m, 0.15, 1e-12);
  EXPECT_EQ(one.height_m, 0);
  const Luminaire disc = read_areas(
      "<BottomFace>" + bottom("200", "200", "50", "<Circular>true</Circular>") + "</BottomFace>");
  EXPECT_NEAR(disc.length_m, 0.2, 1e-12);
  // Two fields of 100 mm whose middles are 300 mm apart, and sides of 40 mm.
  const Luminaire two = read_areas(
      "<BottomFace>" + bottom("100", "80", "-150") + bottom("100", "80", "150") +
      "</BottomFace><C0Face><C0Area><Length>400</Length><Height>40</Height><LengthOffset>0"
      "</LengthOffset><HeightOffset>20</HeightOffset></C0Area></C0Face>");
  EXPECT_NEAR(two.length_m, 0.4, 1e-12);
  EXPECT_NEAR(two.width_m, 0.08, 1e-12);
  EXPECT_NEAR(two.height_m, 0.04, 1e-12);
  EXPECT_EQ(read_areas("").length_m, 0);
  EXPECT_NE(
      error_of_text(
          document_2022("<Emitter><LuminousData>" + list_points(whole_turn, down, hundred) +
                        "</LuminousData><EmissionAreas><BottomFace>" + bottom("wide", "80", "0") +
                        "</BottomFace></EmissionAreas></Emitter>"))
          .find("Length"),
      std::string::npos);
}

TEST(Tm33, FaultsAreNamedWithTheirLine) {
  const auto complain = [](const std::string& points, const std::string& head = {}) {
    return error_of_text(document_2022(emitter_2022(points, head)));
  };
  const std::string points = list_points(quarter, down, hundred);
  const std::string point = "<IntData h=\"0\" v=\"0\">1</IntData>";
  EXPECT_NE(complain(points + point).find("h = 0, v = 0 is given twice"), std::string::npos);
  EXPECT_NE(complain(points + "<IntData h=\"180\" v=\"5\">1</IntData>").find("no intensity at"),
            std::string::npos);
  EXPECT_NE(complain(points + "<IntData h=\"180\" v=\"0\">-1</IntData>").find("negative"),
            std::string::npos);
  EXPECT_NE(complain(points + "<IntData h=\"180\">1</IntData>").find("no number"),
            std::string::npos);
  EXPECT_NE(complain(points, "<Metric>Radiant</Metric>").find("Radiant"), std::string::npos);
  EXPECT_NE(complain(points, "<PhotometryType>Z</PhotometryType>").find("no type"),
            std::string::npos);
  EXPECT_NE(complain(points, "<Multiplier>0</Multiplier>").find("above zero"), std::string::npos);
  EXPECT_NE(complain(point).find("one vertical angle"), std::string::npos);
  EXPECT_NE(complain("").find("lists its intensities"), std::string::npos);
  EXPECT_NE(complain(list_points({90, 180}, down, hundred)).find("horizontal angles"),
            std::string::npos);
  std::string cut = document_2022(emitter_2022(points));
  cut.resize(cut.size() / 2);
  EXPECT_NE(error_of_text(cut).find("broken XML"), std::string::npos);
}

}  // namespace
}  // namespace nightcity::lights
