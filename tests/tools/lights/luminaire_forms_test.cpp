// Luminaire files as programs really write them: editions of the standard, line ends, encodings,
// commas, spellings, and angles that end below the horizon.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "formats/error.h"
#include "tools/lights/ies_table.h"
#include "tools/lights/luminaire.h"

namespace nightcity::lights {
namespace {

using std::numbers::pi;

// 100 cd over the lower half of the sphere.
constexpr double hemisphere_lm = 200 * pi;

class LuminaireForms : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("nightcity_luminaire_forms_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Luminaire read(const std::string& text, const char* name = "a.ies") {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return read_luminaire(path);
  }
  double flux(const std::string& text) { return read(text).flux_lm; }
  std::string error_of(const std::string& text, const char* name = "a.ies") {
    try {
      read(text, name);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

std::string ies(const std::string& counts, const std::string& table,
                const std::string& factors = "1 1 50", const std::string& tilt = "TILT=NONE\n",
                const std::string& edition = "IESNA:LM-63-2002") {
  return edition + "\n[LUMINAIRE] Probe\n" + tilt + "1 1000 1 " + counts + " 2 0 0 0\n" + factors +
         "\n" + table;
}
const std::string even = "0 30 60 90\n0\n100 100 100 100\n";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

TEST_F(LuminaireForms, FileGenerationTypeOfLm63In2019IsNoFactor) {
  for (const char* code : {"1.10000", "1.00001", "1.00010", "1.0"}) {
    const std::string factors = std::string("1.0 ") + code + " 50";
    EXPECT_NEAR(flux(ies("4 1 1", even, factors, "TILT=NONE\n", "IES:LM-63-2019")), hemisphere_lm,
                1e-9);
  }
  EXPECT_NEAR(flux(ies("4 1 1", even, "0.5 1.10000 50", "TILT=NONE\n", "IES:LM-63-2019")),
              0.5 * hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux("\n \n" + ies("4 1 1", even, "1 1.1 50", "TILT=NONE\n", "ies:lm-63-2019")),
              hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux(ies("4 1 1", even, "0.9 0.95 50", "TILT=NONE\n", "IESNA:LM-63-1995")),
              0.9 * 0.95 * hemisphere_lm, 1e-9);
}

TEST_F(LuminaireForms, AZeroInThePlaceForFutureUseIsNoFactor) {
  for (const char* edition : {"IESNA:LM-63-1995", "IESNA:LM-63-2002"})
    EXPECT_NEAR(flux(ies("4 1 1", even, "0.9 0 50", "TILT=NONE\n", edition)), 0.9 * hemisphere_lm,
                1e-9);
  EXPECT_NE(error_of(ies("4 1 1", even, "0.9 0 50", "TILT=NONE\n", "IESNA91"))
                .find("factors must be above zero"),
            std::string::npos);
}

TEST(Lm63Year, IsReadFromEverySpellingOfTheFirstLine) {
  EXPECT_EQ(find_lm63_year("IES:LM-63-2019"), 2019);
  EXPECT_EQ(find_lm63_year("IESNA:LM-63-2019"), 2019);
  EXPECT_EQ(find_lm63_year("IES:LM-63-19"), 2019);
  EXPECT_EQ(find_lm63_year("IESNA:LM-63-1995"), 1995);
  EXPECT_EQ(find_lm63_year("IESNA:LM-63-95"), 1995);
  EXPECT_EQ(find_lm63_year("ies:lm-63-2019"), 2019);
  EXPECT_EQ(find_lm63_year("IESNA91"), 1991);
  EXPECT_EQ(find_lm63_year("IESNA:LM-63-"), 1986);
  EXPECT_EQ(find_lm63_year("A street lamp"), 1986);
}

TEST_F(LuminaireForms, CommasAreDecimalWhereOnlyThatFitsTheCounts) {
  const std::string row = "0 30 60 90\n0\n800,5 400,5 100,5 0,5\n";
  const std::string points = replaced(row, ",", ".");
  EXPECT_NEAR(flux(ies("4 1 1", row)), flux(ies("4 1 1", points)), 1e-9);
  EXPECT_NEAR(flux(ies("4 1 1", row, "1,0 0,9 50,2")), flux(ies("4 1 1", points, "1 0.9 50")),
              1e-9);
  std::string table = "0 30 60 90\n0 90 180 270 360\n";
  for (int plane = 0; plane < 5; ++plane) table += "800,5 400,5 100,5 0,5\n";
  const Luminaire planes = read(ies("4 5 1", table));
  EXPECT_NEAR(*std::max_element(planes.grid.candela.begin(), planes.grid.candela.end()), 800.5,
              1e-9);
  // Here they separate: four numbers stand in the row.
  EXPECT_NEAR(flux(ies("4 1 1", "0,30,60,90\n0\n100,100, 100 ,100\n")), hemisphere_lm, 1e-9);
  // Thousands are neither.
  EXPECT_NE(error_of(ies("4 1 1", "0 30 60 90\n0\n1,800.5 400 100 0\n")).find(":8: numbers remain"),
            std::string::npos);
}

TEST_F(LuminaireForms, ExponentsOfFortranAreRead) {
  EXPECT_NEAR(flux(ies("4 1 1", "0 30 60 9.0D+01\n0\n1.0D2 1.0d+02 .1D3 100\n", "1.0D+00 1 50")),
              hemisphere_lm, 1e-9);
  EXPECT_NE(error_of(ies("4 1 1", "0 30 60 90\n0\n1D 100 100 100\n")).find("is no number"),
            std::string::npos);
}

TEST_F(LuminaireForms, NumbersThatRemainAreRefusedWithTheirLine) {
  EXPECT_NE(error_of(ies("4 1 1", even + "\n100 100\n"))
                .find(":10: numbers remain after the last candela value (\"100\")"),
            std::string::npos);
  EXPECT_NE(error_of(ies("3 1 1", even)).find(":8: numbers remain"), std::string::npos);
  const Luminaire noted = read(ies("4 1 1", even + "END OF FILE\n"));
  EXPECT_NEAR(noted.flux_lm, hemisphere_lm, 1e-9);
  ASSERT_EQ(noted.notes.size(), 1u);
}

TEST_F(LuminaireForms, LineEndsAndEncodingsDoNotMatter) {
  const std::string text = ies("4 1 1", even);
  EXPECT_NEAR(flux(replaced(text, "\n", "\r")), hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux(replaced(text, "\n", "\r\n")), hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux("\xef\xbb\xbf" + text), hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux(text + "\x1a"), hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux(text + std::string(200, '\0')), hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux(replaced(text, " ", "\t")), hemisphere_lm, 1e-9);
  // A fault keeps the number of its line.
  const std::string broken = replaced(text, "100 100", "100 x");
  EXPECT_NE(error_of(broken).find(":8: "), std::string::npos);
  EXPECT_NE(error_of(replaced(broken, "\n", "\r")).find(":8: "), std::string::npos);
  EXPECT_NE(error_of(replaced(broken, "\n", "\r\n")).find(":8: "), std::string::npos);

  std::string little = "\xff\xfe", big = "\xfe\xff";
  for (const char c : replaced(text, "Probe", "P\1")) {  // \1 stands for U+1F4A1, a lamp
    const std::string units = c == 1 ? std::string("\xd8\x3d\xdc\xa1") : std::string({'\0', c});
    for (std::size_t n = 0; n < units.size(); n += 2) {
      big += {units[n], units[n + 1]};
      little += {units[n + 1], units[n]};
    }
  }
  // Zeros in every second place say the same as the mark.
  for (const std::string& wide : {little, big, little.substr(2), big.substr(2)}) {
    EXPECT_NEAR(flux(wide), hemisphere_lm, 1e-9);
    EXPECT_EQ(read(wide).name, "P\xf0\x9f\x92\xa1");
  }
}

TEST_F(LuminaireForms, TiltIsReadInEverySpelling) {
  const std::string table = "1\n3\n0 45 90\n1.0 0.95 0.9\n";
  for (const std::string& tilt :
       {std::string("TILT=NONE\n"), std::string("TILT = NONE\n"), std::string("tilt=none\n"),
        "TILT=INCLUDE\n" + table, "TILT= INCLUDE\n" + table, "Tilt=include\n" + table}) {
    const Luminaire luminaire = read(ies("4 1 1", even, "1 1 50", tilt));
    EXPECT_NEAR(luminaire.flux_lm, hemisphere_lm, 1e-9) << tilt;
    EXPECT_TRUE(luminaire.notes.empty());
    EXPECT_EQ(luminaire.name, "Probe");
  }
  const Luminaire other = read(ies("4 1 1", even, "1 1 50", "TILT=lamp.tlt\n"));
  EXPECT_NEAR(other.flux_lm, hemisphere_lm, 1e-9);
  ASSERT_EQ(other.notes.size(), 1u);
  EXPECT_NE(other.notes[0].find("LAMP.TLT"), std::string::npos);
  EXPECT_NE(error_of(ies("4 1 1", even, "1 1 50", "TILT=\n")).find(":3: TILT="), std::string::npos);
}

TEST_F(LuminaireForms, ThePlaneAt360MayBeLeftOut) {
  std::string planes, rows;
  for (int c = 0; c < 360; c += 15) {
    planes += std::to_string(c) + " ";
    const std::string value = std::to_string(100 + c);
    rows += value + " " + value + "\n";
  }
  const Luminaire luminaire = read(ies("2 24 1", "0 90\n" + planes + "\n" + rows));
  EXPECT_EQ(luminaire.grid.c_degrees.size(), 24u);
  EXPECT_NEAR(intensity_at(luminaire.grid, 345, 45), 445, 1e-9);
  EXPECT_NEAR(intensity_at(luminaire.grid, 352.5, 45), (445 + 100) / 2.0, 1e-9);
  EXPECT_NE(error_of(ies("2 3 1", "0 90\n0 15 100\n1 1\n1 1\n1 1\n")).find(":7: horizontal"),
            std::string::npos);
}

TEST_F(LuminaireForms, OnePlaneOfTypeBIsRefused) {
  for (const char* type : {"2", "3"})
    EXPECT_NE(error_of(ies(std::string("3 1 ") + type, "-90 0 90\n0\n10 100 10\n"))
                  .find(":7: one horizontal angle"),
              std::string::npos);
}

/// Returns the share of a distribution's light above the horizon, by quadrature of what is stored.
double uplight_share(const Photometry& photometry) {
  double up = 0, all = 0;
  const int steps = 18000;
  for (int n = 0; n < steps; ++n) {
    const double gamma = pi * (n + 0.5) / steps;
    for (int c = 0; c < 8; ++c) {
      const double light = intensity_at(photometry, c * pi / 4, gamma) * std::sin(gamma);
      all += light;
      if (gamma > pi / 2) up += light;
    }
  }
  return up / all;
}

TEST_F(LuminaireForms, NothingShinesBeyondTheLastAngle) {
  const struct {
    const char *counts, *table;
    double last_degrees;
  } files[] = {
      {"4 1 1", "0 30 60 90\n0\n100 100 100 100\n", 90},
      {"4 1 1", "0 20 40 60\n0\n100 100 100 100\n", 60},
      {"5 1 1", "0 17 33 60 90\n0\n100 100 100 100 100\n", 90},
      {"3 1 1", "0 41.7 87.3\n0\n100 100 100\n", 87.3},
      {"2 1 1", "0 90\n0\n100 100\n", 90},
      {"2 4 1", "0 90\n0 90 180 270\n100 100\n100 100\n100 100\n100 100\n", 90},
  };
  for (const auto& [counts, table, last] : files) {
    const Luminaire luminaire = read(ies(counts, table));
    const Photometry photometry = luminaire.photometry();
    const double expected = 200 * pi * (1 - std::cos(last * pi / 180));
    EXPECT_NEAR(luminaire.flux_lm, expected, 1e-6) << table;
    EXPECT_NEAR(integrated_flux(photometry), expected, 1e-6) << table;
    EXPECT_NEAR(photometry.extent_degrees, last, 1e-9);
    EXPECT_EQ(uplight_share(photometry), 0) << table;
    EXPECT_EQ(intensity_at(photometry, 1, (last + 0.01) * pi / 180), 0) << table;
  }
}

TEST_F(LuminaireForms, NothingShinesBelowTheFirstAngle) {
  for (const char* table :
       {"90 120 150 180\n0\n100 100 100 100\n", "90 123.4 180\n0\n100 100 100\n"}) {
    const Luminaire up = read(ies(table[3] == '1' && table[6] == ' ' ? "4 1 1" : "3 1 1", table));
    const Photometry photometry = up.photometry();
    EXPECT_NEAR(uplight_share(photometry), 1, 1e-12) << table;
    EXPECT_NEAR(integrated_flux(photometry), up.flux_lm, 0.002 * up.flux_lm) << table;
    EXPECT_NEAR(intensity_at(photometry, 0, 91 * pi / 180), 100, 1e-9) << table;
  }
}

TEST_F(LuminaireForms, ABeamOfTypeBDoesNotShineBackwards) {
  const Luminaire luminaire =
      read(ies("3 3 2", "-90 0 90\n-90 0 90\n100 100 100\n100 100 100\n100 100 100\n"));
  EXPECT_NEAR(luminaire.flux_lm, hemisphere_lm, 1e-3 * hemisphere_lm);
  EXPECT_EQ(uplight_share(luminaire.photometry()), 0);  // "up" is behind it
}

TEST_F(LuminaireForms, ABeamThatEndsAtOnceKeepsItsFlux) {
  // 1,000 cd over 20 degrees of azimuth and the band of 10 degrees above and below: a solid angle
  // of 20 degrees times 2 sin 10.
  const double expected = 1000 * (20 * pi / 180) * 2 * std::sin(10 * pi / 180);
  for (const char* type : {"2", "3"}) {
    const Luminaire luminaire =
        read(ies(std::string("3 3 ") + type,
                 "-10 0 10\n-10 0 10\n1000 1000 1000\n1000 1000 1000\n1000 1000 1000\n"));
    EXPECT_NEAR(luminaire.flux_lm, expected, 0.005 * expected) << type;
    EXPECT_NEAR(integrated_flux(luminaire.photometry()), expected, 0.005 * expected) << type;
  }
}

TEST_F(LuminaireForms, ANarrowBeamOfTypeBKeepsItsPeakAndFlux) {
  // A beam of half a degree, in steps of a tenth: I = 10,000 (1 - |H|)(1 - |V|), angles in degrees.
  std::string angles, rows;
  for (int n = -10; n <= 10; ++n) angles += std::to_string(n / 10.0) + " ";
  for (int h = -10; h <= 10; ++h) {
    for (int v = -10; v <= 10; ++v)
      rows += std::to_string(100 * (10 - std::abs(h)) * (10 - std::abs(v))) + " ";
    rows += "\n";
  }
  const Luminaire luminaire = read(ies("21 21 2", angles + "\n" + angles + "\n" + rows));
  const double degree = pi / 180;
  EXPECT_NEAR(luminaire.flux_lm, 10000 * degree * degree, 0.02 * 10000 * degree * degree);
  EXPECT_NEAR(intensity_at(luminaire.photometry(), 0, 0), 10000, 1);
}

std::string ldt(const std::string& gammas, std::size_t count, const std::string& values) {
  std::string text = "Maker\n3\n1\n1\n0\n" + std::to_string(count) +
                     "\n30\nreport\nTest\nnumber\nfile\ndate\n600\n200\n100\n500\n200\n0\n0\n0\n0\n"
                     "100\n100\n1\n0\n1\n1\nLED\n1000\n3000\n80\n20\n";
  for (int n = 0; n < 10; ++n) text += "0.5\n";
  return text + "0\n" + gammas + values;
}

TEST_F(LuminaireForms, EulumdatEndsAtItsLastAngleToo) {
  const Luminaire luminaire = read(ldt("0\n30\n60\n90\n", 4, "100\n100\n100\n100\n"), "a.ldt");
  EXPECT_NEAR(luminaire.flux_lm, hemisphere_lm, 1e-6);
  EXPECT_NEAR(integrated_flux(luminaire.photometry()), hemisphere_lm, 1e-6);
  EXPECT_EQ(uplight_share(luminaire.photometry()), 0);
}

TEST_F(LuminaireForms, EulumdatMayLeaveLinesBlankThatTheLightDoesNotNeed) {
  std::string text = ldt("0\n30\n60\n90\n", 4, "100\n100\n100\n100\n");
  const auto blank = [&](const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), with);
  };
  blank("4\n30\nreport", "4\n\nreport");            // the distance of gamma angles
  blank("500\n200\n0\n0\n0\n0\n", "\n\n\n\n\n\n");  // the luminous area
  blank("100\n100\n1\n0\n1\n1\nLED", "\n\n\n\n1\n\nLED");
  const Luminaire luminaire = read(text, "a.ldt");
  EXPECT_NEAR(luminaire.flux_lm, hemisphere_lm, 1e-6);
  EXPECT_EQ(luminaire.length_m, 0);
  EXPECT_EQ(luminaire.stated_flux_lm, 0);
  EXPECT_TRUE(begins_as_eulumdat(text));
}

// As an IES file of less than no lamps, a negative ratio states nothing.
// Sets of lamps are alternatives.
TEST_F(LuminaireForms, EulumdatOfSeveralSetsTellsWhichIsUsed) {
  const std::string text = ldt("0\n30\n60\n90\n", 4, "100\n100\n100\n100\n");
  const std::string one = "1\n1\nLED\n1000\n3000\n80\n20\n";
  ASSERT_NE(text.find(one), std::string::npos) << text;
  const auto with = [&](const char* flux) {
    return replaced(
        text, one,
        "2\n1\nLED\n1000\n3000\n80\n20\n1\nLED\n" + std::string(flux) + "\n3000\n80\n10\n");
  };
  const Luminaire two = read(with("4000"), "a.ldt");
  EXPECT_NEAR(two.flux_lm, 200 * pi, 1e-6);
  ASSERT_EQ(two.notes.size(), 1u);
  EXPECT_NE(two.notes[0].find("2 sets of lamps, of which the first is used"), std::string::npos);
  EXPECT_TRUE(read(with("1000"), "a.ldt").notes.empty()) << "of the same light";
  const std::string three =
      replaced(with("4000"), "2\n1\nLED\n1000\n", "3\n1\nLED\n1000\n3000\n80\n20\n1\nLED\n4000\n");
  const std::string back =
      replaced(three, "LED\n4000\n3000\n80\n10\n", "LED\n1000\n3000\n80\n10\n");
  EXPECT_EQ(read(back, "a.ldt").notes.size(), 1u) << "the last is as the first, and one is not";
}

TEST_F(LuminaireForms, EulumdatHasNoNegativeSizesAndFluxes) {
  const std::string text = ldt("0\n30\n60\n90\n", 4, "100\n100\n100\n100\n");
  const Luminaire round = read(replaced(text, "500\n200\n0\n", "-500\n-200\n-50\n"), "a.ldt");
  EXPECT_DOUBLE_EQ(round.length_m, 0.5);
  EXPECT_DOUBLE_EQ(round.width_m, 0.2);
  EXPECT_DOUBLE_EQ(round.height_m, 0.05);
  EXPECT_NEAR(round.flux_lm, hemisphere_lm, 1e-6);
  EXPECT_EQ(read(replaced(text, "100\n100\n1\n0\n1\n1\nLED", "100\n-100\n1\n0\n1\n1\nLED"), "a.ldt")
                .stated_flux_lm,
            0);
}

TEST_F(LuminaireForms, EulumdatCommasLineEndsAndRemainingNumbers) {
  const std::string text = ldt("0\n30\n60\n90\n", 4, "100,5\n100,5\n100,5\n100,5\n");
  EXPECT_NEAR(read(text, "a.ldt").flux_lm, 201 * pi, 1e-6);
  EXPECT_NEAR(read(replaced(text, "\n", "\r"), "a.ldt").flux_lm, 201 * pi, 1e-6);
  EXPECT_NE(error_of(text + "\n100\n", "a.ldt").find("numbers remain after the last intensity"),
            std::string::npos);
}

TEST_F(LuminaireForms, AFileOfAnotherKindIsNamed) {
  EXPECT_NE(error_of("<!DOCTYPE html><html><body/></html>").find("is a web page"),
            std::string::npos);
  EXPECT_NE(error_of("%PDF-1.4", "a.ldt").find("is a PDF document"), std::string::npos);
}

TEST(LuminaireMarks, ContentTellsBothFormats) {
  EXPECT_TRUE(begins_as_ies("TILT=NONE\n1 1000 1"));
  EXPECT_TRUE(begins_as_ies("A lamp\r tilt = include\r"));
  EXPECT_TRUE(begins_as_ies("\n\niesna:lm-63-2002\n"));
  EXPECT_FALSE(begins_as_ies("it has no TILT=NONE\n"));
  const std::string head = ldt("0\n90\n", 2, "100\n100\n");
  EXPECT_TRUE(begins_as_eulumdat(head));
  EXPECT_TRUE(begins_as_eulumdat(replaced(head, "\n", "\r\n")));
  EXPECT_FALSE(begins_as_eulumdat("Maker\n3\n5\n1\n0\n2\n30\n"));
  EXPECT_FALSE(begins_as_eulumdat("Maker\n3\n1\n"));
  EXPECT_FALSE(begins_as_eulumdat("id,lon,lat\n1,2,3\n1\n1\n1\n2\n3\n"));
}

TEST_F(LuminaireForms, NamesInWindows1252AreReadAsUtf8) {
  const Luminaire luminaire = read(replaced(ies("4 1 1", even), "Probe",
                                            "Stra\xDF"
                                            "enleuchte \x80"));
  EXPECT_EQ(luminaire.name,
            "Stra\xC3\x9F"
            "enleuchte \xE2\x82\xAC");
}

TEST_F(LuminaireForms, AFileOfNeitherFormatIsToldSo) {
  EXPECT_NE(error_of("hello\n").find("neither EULUMDAT nor IES"), std::string::npos);
}

// Form feeds, blanks that do not break, and a turn that begins elsewhere than at 0.
TEST_F(LuminaireForms, PagesBlanksAndTurnsAsProgramsWriteThem) {
  EXPECT_NEAR(flux("\f" + ies("4 1 1", "\f" + even)), hemisphere_lm, 1e-9);
  EXPECT_NEAR(flux(ies("4 1 1", replaced(even, " ", "\xc2\xa0"))), hemisphere_lm, 1e-9);
  const std::string row = "100 100 100 100\n";
  for (const char* planes :
       {"15 105 195 285", "-180 -90 0 90 180", "-90 0 90 180", "0 90 180 270"}) {
    const std::string angles(planes);
    const auto count = 1 + std::count(angles.begin(), angles.end(), ' ');
    std::string table = "0 30 60 90\n" + angles + "\n";
    for (std::ptrdiff_t n = 0; n < count; ++n) table += row;
    EXPECT_NEAR(flux(ies("4 " + std::to_string(count) + " 1", table)), hemisphere_lm, 1e-6)
        << planes;
  }
  // The plane at 105 degrees is the brightest, wherever the list begins.
  const Luminaire turned = read(ies("2 4 1", "0 90\n15 105 195 285\n1 1\n9 9\n1 1\n1 1\n"));
  EXPECT_NEAR(intensity_at(turned.grid, 105, 45), 9, 1e-9);
  EXPECT_NEAR(intensity_at(turned.grid, 0, 45), 1, 1e-9);
  EXPECT_NEAR(intensity_at(turned.grid, 60, 45), 5, 1e-9);
  for (const char* planes : {"90 180", "180 270", "720 900 1080", "-720 -540 -360"}) {
    const std::string angles(planes);
    const auto count = 1 + std::count(angles.begin(), angles.end(), ' ');
    std::string table = "0 30 60 90\n" + angles + "\n";
    for (std::ptrdiff_t n = 0; n < count; ++n) table += row;
    EXPECT_NE(error_of(ies("4 " + std::to_string(count) + " 1", table)).find("horizontal angles"),
              std::string::npos)
        << planes;
  }
}

TEST_F(LuminaireForms, OfSeveralLuminairesTheFirstIsReadAndToldSo) {
  const std::string one = ies("4 1 1", even);
  const Luminaire first = read(one + one + one);
  EXPECT_NEAR(first.flux_lm, hemisphere_lm, 1e-9);
  EXPECT_EQ(first.notes,
            (std::vector<std::string>{"the file holds 3 luminaires, of which the first is read"}));
  EXPECT_TRUE(read(one).notes.empty());
}

}  // namespace
}  // namespace nightcity::lights
