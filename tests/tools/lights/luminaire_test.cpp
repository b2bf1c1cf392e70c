// Luminaire files: distributions known in closed form and written as text, with every symmetry and
// every fault; then real files, whose makers state the flux.
#include "tools/lights/luminaire.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>

#include "formats/error.h"
#include "support/data.h"

namespace nightcity::lights {
namespace {

using std::numbers::pi;

constexpr double degree = pi / 180;

class LuminaireFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("nightcity_luminaire_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text, const char* name = "a.ies") {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string error_of(const std::string& text) {
    try {
      read_luminaire(write(text));
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

using Distribution = std::function<double(double c_degrees, double gamma_degrees)>;

std::vector<double> steps(double from, double to, double step) {
  std::vector<double> result;
  for (double angle = from; angle < to + step / 2; angle += step) result.push_back(angle);
  return result;
}

std::string list(const std::vector<double>& numbers) {
  std::ostringstream text;
  text.precision(12);
  for (const double number : numbers)
    text << number << (&number - numbers.data() == 7 ? "\n" : " ");
  return text.str() + "\n";
}

std::string ies(const std::vector<double>& vertical, const std::vector<double>& horizontal,
                const Distribution& candela, int type = 1, const std::string& factors = "1 1 50") {
  std::ostringstream text;
  text << "IESNA:LM-63-2002\n[MANUFAC] Maker\n[LUMINAIRE] Test\nTILT=NONE\n1 -1 1 "
       << vertical.size() << " " << horizontal.size() << " " << type << " 2 0.2 0.5 0.1\n"
       << factors << "\n"
       << list(vertical) << list(horizontal);
  for (const double h : horizontal) {
    std::vector<double> row;
    for (const double v : vertical) row.push_back(candela(h, v));
    text << list(row);
  }
  return text.str();
}

std::string ldt(int symmetry, const std::vector<double>& planes, const std::vector<double>& gammas,
                std::size_t first, std::size_t count, const Distribution& per_klm,
                double lumens = 2000, double output_ratio = 100) {
  std::ostringstream text;
  text.precision(12);
  text << "Maker\n3\n"
       << symmetry << "\n"
       << planes.size() << "\n15\n"
       << gammas.size()
       << "\n5\nreport\nTest\nnumber\nfile\ndate\n600\n200\n100\n500\n200\n0\n0\n0\n0\n100\n"
       << output_ratio << "\n1\n0\n1\n1\nLED\n"
       << lumens << "\n3000\n80\n20\n";
  for (int n = 0; n < 10; ++n) text << "0.5\n";
  for (const double angle : planes) text << angle << "\n";
  for (const double angle : gammas) text << angle << "\n";
  for (std::size_t n = 0; n < count; ++n)
    for (const double gamma : gammas)
      text << per_klm(planes[(first + n) % planes.size()], gamma) << "\n";
  return text.str();
}

double lambert(double, double gamma) {
  return std::max(0.0, 1000 * std::cos(gamma * degree));
}
/// A distribution that is symmetric about both axes.
double oval(double c, double gamma) {
  return lambert(c, gamma) * (1.5 + std::cos(2 * c * degree));
}
/// A distribution with more light towards C = 0.
double forward(double c, double gamma) {
  return lambert(c, gamma) * (2 + std::cos(c * degree));
}

TEST_F(LuminaireFile, LambertianIesHasItsClosedFormFlux) {
  const Luminaire luminaire = read_luminaire(write(ies(steps(0, 90, 1), {0}, lambert)));
  EXPECT_NEAR(luminaire.flux_lm, 1000 * pi, 1000 * pi * 1e-3);
  EXPECT_EQ(luminaire.name, "Test");
  EXPECT_EQ(luminaire.manufacturer, "Maker");
  EXPECT_NEAR(luminaire.length_m, 0.5, 1e-12);
  EXPECT_EQ(luminaire.photometry().c_count, 1u);
  EXPECT_EQ(luminaire.photometry().gamma_count, 91u);
  EXPECT_EQ(luminaire.photometry().extent_degrees, 90);
  EXPECT_NEAR(integrated_flux(luminaire.photometry()), luminaire.flux_lm, 1);
}

TEST_F(LuminaireFile, FactorsMultiplyCandela) {
  const double plain = read_luminaire(write(ies(steps(0, 90, 5), {0}, lambert))).flux_lm;
  EXPECT_NEAR(read_luminaire(write(ies(steps(0, 90, 5), {0}, lambert, 1, "0.5 0.8 50"))).flux_lm,
              0.4 * plain, 1e-6);
}

TEST_F(LuminaireFile, EveryIesSymmetryUnfoldsToTheSameDistribution) {
  for (const auto& [from, to] : {std::pair{0.0, 90.0}, {0.0, 180.0}, {0.0, 360.0}, {90.0, 270.0}}) {
    const Luminaire luminaire =
        read_luminaire(write(ies(steps(0, 180, 5), steps(from, to, 15), oval)));
    for (double c = 0; c < 360; c += 15)
      for (double gamma = 0; gamma <= 180; gamma += 15)
        ASSERT_NEAR(intensity_at(luminaire.grid, c, gamma), oval(c, gamma), 1e-6)
            << from << " to " << to << " at " << c;
    EXPECT_NEAR(luminaire.flux_lm, 1500 * pi, 10);
  }
  const Luminaire half = read_luminaire(write(ies(steps(0, 90, 5), steps(0, 180, 15), forward)));
  EXPECT_NEAR(intensity_at(half.grid, 300, 40), forward(60, 40), 1e-6);
}

TEST_F(LuminaireFile, EveryEulumdatSymmetryUnfoldsToTheSameDistribution) {
  const auto planes = steps(0, 345, 15), gammas = steps(0, 180, 5);
  const std::size_t n = planes.size();
  const struct {
    int symmetry;
    std::size_t first, count;
  } sectors[] = {{0, 0, n}, {2, 0, n / 2 + 1}, {3, 3 * n / 4, n / 2 + 1}, {4, 0, n / 4 + 1}};
  for (const auto& [symmetry, first, count] : sectors) {
    const Luminaire luminaire =
        read_luminaire(write(ldt(symmetry, planes, gammas, first, count, oval), "a.ldt"));
    for (double c = 0; c < 360; c += 15)
      for (double gamma = 0; gamma <= 180; gamma += 15)
        ASSERT_NEAR(intensity_at(luminaire.grid, c, gamma), 2 * oval(c, gamma), 1e-6)
            << "symmetry " << symmetry;
  }
  const Luminaire round =
      read_luminaire(write(ldt(1, planes, gammas, 0, 1, lambert, 3000, 80), "a.ldt"));
  EXPECT_NEAR(round.flux_lm, 3 * 1000 * pi, 3000 * pi * 3e-3);
  EXPECT_NEAR(round.stated_flux_lm, 2400, 1e-9);
}

TEST_F(LuminaireFile, PhotometricTypesAAndBAreTurnedIntoTheBeamsFrame) {
  // A Lambertian emitter has I = cos V cos H in type A and in type B.
  const auto both = [](double h, double v) {
    return 1000 * std::cos(h * degree) * std::cos(v * degree);
  };
  for (const int type : {2, 3})
    for (const double from : {-90.0, 0.0}) {
      const Luminaire luminaire =
          read_luminaire(write(ies(steps(from, 90, 2), steps(from, 90, 2), both, type)));
      EXPECT_NEAR(luminaire.flux_lm, 1000 * pi, 1000 * pi * 2e-3) << type;
      EXPECT_NEAR(intensity_at(luminaire.grid, 40, 60), 500, 3) << type;
      EXPECT_NEAR(intensity_at(luminaire.grid, 40, 120), 0, 1e-6) << type;
    }
  // Up is C = 0: this beam grows with V.
  const auto upwards = [](double, double v) { return 90 + v; };
  const Luminaire up = read_luminaire(write(ies(steps(-90, 90, 5), steps(-90, 90, 5), upwards, 3)));
  EXPECT_NEAR(intensity_at(up.grid, 0, 45), 135, 1);
  EXPECT_NEAR(intensity_at(up.grid, 180, 45), 45, 1);
}

TEST_F(LuminaireFile, StreetSideIsFoundWhereverTheFileHasIt) {
  const auto road = [](double turn) {
    return [turn](double c, double gamma) {
      const double a =
          (c - turn) * degree;  // long across the street's direction, more light in front
      return lambert(c, gamma) * (2 - std::cos(2 * a) + 0.6 * std::cos(a));
    };
  };
  for (const double turn : {0.0, 90.0, 180.0, 270.0}) {
    const Luminaire luminaire =
        read_luminaire(write(ies(steps(0, 90, 5), steps(0, 360, 15), road(turn))));
    EXPECT_EQ(luminaire.street_side_degrees, turn);
    const Photometry photometry = luminaire.photometry();
    EXPECT_NEAR(intensity_at(photometry, 0, 0.5), intensity_at(luminaire.grid, turn, 0.5 / degree),
                1e-6);
    EXPECT_GT(intensity_at(photometry, 0, 0.5), intensity_at(photometry, pi, 0.5));
  }
  EXPECT_EQ(read_luminaire(write(ies(steps(0, 90, 5), {0}, lambert))).street_side_degrees, 0);
}

TEST_F(LuminaireFile, LightsTurnTheOtherWayThanFiles) {
  // A file counts C anticlockwise from above, a light towards cross(axis, tangent), clockwise for
  // an axis down.
  const auto skew = [](double c, double gamma) {
    return lambert(c, gamma) * (2 + std::sin(c * degree));
  };
  Luminaire luminaire = read_luminaire(write(ies(steps(0, 90, 5), steps(0, 360, 15), skew)));
  luminaire.street_side_degrees = 0;
  const Photometry photometry = luminaire.photometry();
  EXPECT_NEAR(intensity_at(photometry, pi / 2, 0), intensity_at(luminaire.grid, 270, 0), 1e-9);
  EXPECT_LT(intensity_at(photometry, pi / 2, 0.7), intensity_at(photometry, 3 * pi / 2, 0.7));
}

TEST_F(LuminaireFile, IrregularAnglesKeepTheirFluxToHalfAPercent) {
  const std::vector<double> gammas = {0, 3, 11, 20, 33.3, 45, 47.5, 60, 71, 82, 90},
                            planes = {0, 7, 20, 45, 61, 90};
  const Luminaire luminaire = read_luminaire(write(ies(gammas, planes, oval)));
  EXPECT_NEAR(integrated_flux(luminaire.photometry()), luminaire.flux_lm,
              0.005 * luminaire.flux_lm);
}

TEST_F(LuminaireFile, TiltTablesAreReadOverAndCommasSeparate) {
  std::string text = ies(steps(0, 90, 5), {0}, lambert);
  const double flux = read_luminaire(write(text)).flux_lm;
  text.replace(text.find("TILT=NONE\n"), 10, "TILT=INCLUDE\n1\n3\n0 45 90\n1.0, 0.95,0.9\n");
  EXPECT_NEAR(read_luminaire(write(text)).flux_lm, flux, 1e-9);
}

TEST_F(LuminaireFile, FaultsAreToldWithTheirLine) {
  const std::string good = ies({0, 45, 90}, {0}, lambert);
  const auto broken = [&](const std::string& what, const std::string& with) {
    std::string text = good;
    text.replace(text.find(what), what.size(), with);
    return error_of(text);
  };
  EXPECT_EQ(error_of(good), "no error");
  EXPECT_NE(broken("0 45 90", "0 45 x").find(":7: \"x\" is no number (vertical angles)"),
            std::string::npos);
  EXPECT_NE(broken("0 45 90", "0 90 45").find(":7: vertical angles do not ascend"),
            std::string::npos);
  EXPECT_NE(broken("1 -1 1 3 1 1 2", "1 -1 1 3 1 7 2").find(":5: the photometric type is 7"),
            std::string::npos);
  EXPECT_NE(broken("1 -1 1 3 1 1 2", "1 -1 1 1e9 1 1 2").find(":5: "), std::string::npos);
  EXPECT_NE(broken("1 -1 1 3 1 1 2", "1 -1 0 3 1 1 2").find("above zero"), std::string::npos);
  EXPECT_NE(broken("1000", "-1000").find(":9: negative candela"), std::string::npos);
  EXPECT_NE(broken("1000", "nan").find("is no number"), std::string::npos);
  EXPECT_NE(broken("0 45 90 \n0 \n", "0 45 200 \n0 \n").find("between 0 and 180"),
            std::string::npos);
  EXPECT_NE(error_of(good.substr(0, good.rfind("1000"))).find("the file ends"), std::string::npos);
  EXPECT_NE(error_of(ies({0, 90}, {0}, [](double, double) { return 0; })).find("gives no light"),
            std::string::npos);
  EXPECT_NE(error_of(ies({0, 90}, {0, 70}, lambert)).find("horizontal angles of type C"),
            std::string::npos);
  EXPECT_NE(error_of("").find("empty"), std::string::npos);
  EXPECT_NE(error_of(std::string("a\0b", 3)).find("not a text file"), std::string::npos);
  EXPECT_NE(error_of("IESNA:LM-63-2002\n[TEST] x\n").find("no TILT="), std::string::npos);
  EXPECT_NE(error_of("hello\nworld\n").find(":2: \"world\" is no number (the type of luminaire)"),
            std::string::npos);
  EXPECT_THROW(read_luminaire(folder_ / "absent.ies"), Error);
}

TEST_F(LuminaireFile, EulumdatFaultsAreToldWithTheirLine) {
  const auto planes = steps(0, 345, 15), gammas = steps(0, 90, 5);
  EXPECT_NE(error_of(ldt(4, planes, gammas, 0, 5, oval)).find("the file ends where intensities"),
            std::string::npos);
  EXPECT_NE(error_of(ldt(9, planes, gammas, 0, 7, oval)).find(":3: the symmetry is 9"),
            std::string::npos);
  EXPECT_NE(error_of(ldt(0, planes, gammas, 0, 24, oval, 0)).find("flux must be above zero"),
            std::string::npos);
  EXPECT_NE(error_of(ldt(4, steps(0, 330, 30), {0, 90, 45}, 0, 4, oval))
                .find("gamma angles do not ascend"),
            std::string::npos);
  EXPECT_NE(error_of(ldt(4, steps(0, 270, 45), gammas, 0, 4, oval)).find("do not fit symmetry 4"),
            std::string::npos);
}

// Real files: the flux of the distribution agrees with what its maker states.
TEST(LuminaireReal, FluxIsWhatTheMakersState) {
  const struct {
    const char* file;
    double lumens;
  } files[] = {
      {"ies/eulumdat-rs_road_luminaire.ldt", 33200 * 0.8442},
      {"ies/eulumdat_OutdoorRoadway_60W_4000K.ies", 9155.7},
      {"ies/rab_1_PRT70_roadway.IES", 9217},  // [_ABSOLUTELUMENS]
  };
  for (const auto& [name, lumens] : files) {
    REAL_DATA(file, name);
    const Luminaire luminaire = read_luminaire(file);
    EXPECT_NEAR(luminaire.flux_lm, lumens, 0.005 * lumens) << name;
    EXPECT_NEAR(integrated_flux(luminaire.photometry()), luminaire.flux_lm,
                0.005 * luminaire.flux_lm)
        << name;
  }
}

TEST(LuminaireReal, StreetSidesAreFound) {
  const struct {
    const char* file;
    double degrees;
  } files[] = {{"ies/eulumdat-rs_road_luminaire.ldt", 270},
               {"ies/luxpy_Isym3.ies", 270},
               {"ies/eulumdat_OutdoorRoadway_60W_4000K.ies", 0}};
  for (const auto& [name, degrees] : files) {
    REAL_DATA(file, name);
    EXPECT_EQ(read_luminaire(file).street_side_degrees, degrees) << name;
  }
}

}  // namespace
}  // namespace nightcity::lights
