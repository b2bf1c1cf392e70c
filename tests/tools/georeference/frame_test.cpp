#include "tools/georeference/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/error.h"
#include "support/temp_folder.h"

namespace nightcity::georeference {
namespace {

using Points = std::vector<glm::dvec3>;

CityFrame frame_of(const std::string& srs, const Points& sample, CityFrame::Options options = {}) {
  return CityFrame::from_srs_name(srs, sample, options);
}

glm::dvec3 project(const CityFrame& frame, glm::dvec3 c) {
  frame.to_projected(std::span(&c, 1));
  return c;
}

// Returns closed rings of a box of side `s` at (x, y, z), normals outward in a right-handed x, y,
// z.
Points box_rings(double x, double y, double z, double s) {
  const auto p = [&](int i, int j, int k) { return glm::dvec3{x + i * s, y + j * s, z + k * s}; };
  const Points faces[] = {{p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)},
                          {p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)},
                          {p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)},
                          {p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0)}};
  Points out;
  for (const Points& face : faces) {
    out.insert(out.end(), face.begin(), face.end());
    out.push_back(face.front());
  }
  return out;
}

Points swapped(Points points) {
  for (glm::dvec3& p : points) std::swap(p.x, p.y);
  return points;
}

void expect_near(const glm::dvec2& a, const glm::dvec2& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

// Closed form of UTM on the central meridian and the equator: easting 500000, northing k0 times the
// meridian arc.
TEST(Frame, UtmCentralMeridianHasEasting500000) {
  const CityFrame frame = frame_of("EPSG:25833", {{500000, 5800000, 30}});
  EXPECT_NEAR(frame.from_lon_lat({15, 52}).x, 500000, 1e-3);
  // Quarter meridian of GRS 80: 10001965.729 m to the pole; half-way in latitude, 45 degrees:
  // 4984944.378 m (k0 0.9996).
  EXPECT_NEAR(frame.from_lon_lat({15, 45}).y, 0.9996 * 4984944.378, 0.01);
  EXPECT_EQ(frame.crs(), "EPSG:25833");
}

TEST(Frame, LonLatGoesThereAndBack) {
  for (const char* srs : {"EPSG:25832", "EPSG:28992", "EPSG:31256", "EPSG:27700", "EPSG:2180"}) {
    const CityFrame frame = frame_of(srs, {});
    const glm::dvec2 place = std::string(srs) == "EPSG:27700"   ? glm::dvec2{-0.1, 51.5}
                             : std::string(srs) == "EPSG:28992" ? glm::dvec2{4.5, 51.9}
                             : std::string(srs) == "EPSG:2180"  ? glm::dvec2{19.1, 52.6}
                                                                : glm::dvec2{13, 48.1};
    expect_near(frame.to_lon_lat(frame.from_lon_lat(place)), place, 1e-7);
  }
}

TEST(Frame, GermanNameGivesTheSameFrameAsItsCode) {
  const Points sample{{324500, 5729500, 20}};
  const CityFrame adv = frame_of("urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH*GCG2016", sample);
  const CityFrame epsg = frame_of("EPSG:25832", sample);
  EXPECT_EQ(adv.crs(), "EPSG:25832");
  expect_near(adv.from_lon_lat({6.46, 51.69}), epsg.from_lon_lat({6.46, 51.69}), 1e-6);
}

TEST(Frame, AxisOrderFollowsTheAreaOfUseWhereTheFileBreaksTheBook) {
  // Helsinki's EPSG:3879 is north, east in the register, but published files hold east, north.
  const CityFrame east_first = frame_of("urn:ogc:def:crs:EPSG::3879", {{25499065, 6674607, 3}});
  EXPECT_EQ(project(east_first, {25499065, 6674607, 3}), glm::dvec3(25499065, 6674607, 3));
  EXPECT_NE(east_first.description().find("against"), std::string::npos);
  EXPECT_NE(east_first.axis_warning().find("against"), std::string::npos);
  const CityFrame north_first = frame_of("urn:ogc:def:crs:EPSG::3879", {{6674607, 25499065, 3}});
  EXPECT_EQ(project(north_first, {6674607, 25499065, 3}), glm::dvec3(25499065, 6674607, 3));
}

TEST(Frame, RingsDecideTheAxisOrderWhereTheAreaAllowsBoth) {
  // Poland's EPSG:2180 spans about 700 km in both axes: a place is possible in either order.
  const Points east_north = box_rings(504537, 532287, 60, 10);
  const CityFrame a = frame_of("urn:ogc:def:crs,crs:EPSG::2180,crs:PL-EVRF2007-NH", east_north);
  EXPECT_EQ(project(a, {504537, 532287, 60}), glm::dvec3(504537, 532287, 60));
  const CityFrame b =
      frame_of("urn:ogc:def:crs,crs:EPSG::2180,crs:PL-EVRF2007-NH", swapped(east_north));
  EXPECT_EQ(project(b, {532287, 504537, 60}), glm::dvec3(504537, 532287, 60));
}

// Returns the rings of a box of 9 x 12 m in latitude and longitude, turned by `turn` radians.
Points box_in_degrees(glm::dvec2 lat_lon, double turn, bool inside_out) {
  Points rings = box_rings(0, 0, 100, 9);
  const double c = std::cos(turn), s = std::sin(turn), degree = 111'320;
  for (glm::dvec3& p : rings) {
    const double x = c * p.x * 4 / 3 - s * p.y, y = s * p.x * 4 / 3 + c * p.y;
    p = {lat_lon.x + y / degree, lat_lon.y + x / degree / std::cos(lat_lon.x * M_PI / 180), p.z};
  }
  if (inside_out) std::reverse(rings.begin(), rings.end());
  return rings;
}

TEST(Frame, UrnFixesTheAxisOrderWhateverRingsAreWoundLike) {
  for (const char* name :
       {"urn:ogc:def:crs:EPSG::4326", "http://www.opengis.net/def/crs/EPSG/0/4979",
        "urn:ogc:def:crs,crs:EPSG::4258,crs:EPSG::7837"})
    for (const double turn : {0.0, 0.5})
      for (const bool inside_out : {false, true}) {
        const CityFrame frame = frame_of(name, box_in_degrees({48.996, 9.0015}, turn, inside_out));
        const glm::dvec3 p = project(frame, {48.996, 9.0015, 10});
        expect_near(frame.to_lon_lat(glm::dvec2(p)), {9.0015, 48.996}, 1e-5);
        // The rings are not asked if only one order lies in the area of use.
        const bool asked = std::string(name).find("4258") == std::string::npos;
        EXPECT_EQ(frame.axis_warning().empty(), !(asked && inside_out)) << frame.axis_warning();
      }
  // SVY21 is north, east in the register, and both orders lie in Singapore.
  for (const bool inside_out : {false, true}) {
    Points rings = swapped(box_rings(29501, 38744, 10, 10));
    if (inside_out) std::reverse(rings.begin(), rings.end());
    const CityFrame frame = frame_of("urn:ogc:def:crs:EPSG::3414", rings);
    const glm::dvec3 p = project(frame, {38744, 29501, 10});
    expect_near(glm::dvec2(p), {29501, 38744}, 1e-6);
    EXPECT_EQ(frame.axis_warning().empty(), !inside_out) << frame.axis_warning();
  }
}

// A published model of Karlsruhe has longitude first under the URN of EPSG:4326, and its buildings
// stand at an angle to the axes.
TEST(Frame, RightAnglesShowThatAFileBreaksItsUrn) {
  Points rings;
  for (int i = 0; i < 5; ++i) {
    const Points box = swapped(box_in_degrees({49.02, 8.44 + 0.001 * i}, 0.4, false));
    rings.insert(rings.end(), box.begin(), box.end());
  }
  const CityFrame frame = frame_of("urn:ogc:def:crs:EPSG::4326", rings);
  const glm::dvec3 p = project(frame, {8.44, 49.02, 10});
  expect_near(frame.to_lon_lat(glm::dvec2(p)), {8.44, 49.02}, 1e-5);
  EXPECT_NE(frame.description().find("right angles"), std::string::npos) << frame.description();
}

// 100 m on the ground at 49 degrees north are 152 m of Pseudo-Mercator.
TEST(Frame, PseudoMercatorBecomesMetresOnTheGround) {
  const double x = 9.0 * M_PI / 180 * 6378137;
  const double y = std::log(std::tan(M_PI / 4 + 49.0 * M_PI / 360)) * 6378137;
  for (const char* name : {"EPSG:3857", "urn:ogc:def:crs:EPSG::3857"}) {
    const CityFrame frame = frame_of(name, {{x, y, 100}});
    const glm::dvec3 a = project(frame, {x, y, 100}), b = project(frame, {x + 152.31, y, 107});
    EXPECT_NEAR(b.x - a.x, 100.1, 0.3) << name;  // cos 49 degrees, and the ellipsoid's radius
    EXPECT_NEAR(b.z - a.z, 7, 1e-9);
    expect_near(frame.to_lon_lat(glm::dvec2(a)), {9, 49}, 1e-7);
    expect_near(frame.from_lon_lat({9, 49}), glm::dvec2(a), 1e-3);
    EXPECT_NE(frame.description().find("no metric grid"), std::string::npos);
  }
}

// A shape of 1 m is no shape of 0.66 m.
TEST(Frame, ShapesPlacedInPseudoMercatorAreMetres) {
  const double x = 9.0 * M_PI / 180 * 6378137;
  const double y = std::log(std::tan(M_PI / 4 + 49.0 * M_PI / 360)) * 6378137;
  const CityFrame frame = frame_of("EPSG:3857", {{x, y, 100}});
  Points shape{{x + 1, y, 100}, {x, y + 1, 100}, {x, y, 101}};
  frame.to_projected(shape, glm::dvec3(x, y, 100));
  const glm::dvec3 anchor = project(frame, {x, y, 100});
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(shape[axis][axis] - anchor[axis], 1, 1e-6);
}

// Polar stereographic (Snyder 1987, equations 15-9, 21-33 and 21-34) on the ellipsoid of WGS 84,
// with scale 1 at a latitude; northern aspect, degrees.
glm::dvec2 to_polar(const glm::dvec2& lon_lat, double true_latitude, double central_meridian) {
  constexpr double a = 6378137, f = 1 / 298.257223563, degree = M_PI / 180;
  const double e = std::sqrt(f * (2 - f));
  const auto t = [&](double lat) {
    const double s = std::sin(lat * degree);
    return std::tan(M_PI / 4 - lat * degree / 2) / std::pow((1 - e * s) / (1 + e * s), e / 2);
  };
  const double s = std::sin(true_latitude * degree);
  const double m = std::cos(true_latitude * degree) / std::sqrt(1 - e * e * s * s);
  const double rho = a * m * t(lon_lat.y) / t(true_latitude);
  const double angle = (lon_lat.x - central_meridian) * degree;
  return {rho * std::sin(angle), -rho * std::cos(angle)};
}

TEST(Frame, GridsRoundAPoleBecomeMetresWithTrueNorth) {
  const glm::dvec2 place(15.64, 78.22);  // Longyearbyen
  // 100 m to the east and to the north, by the radii of the ellipsoid there.
  constexpr double a = 6378137, e2 = 0.00669437999014, degree = M_PI / 180;
  const double s = std::sin(place.y * degree), w = std::sqrt(1 - e2 * s * s);
  const glm::dvec2 east(place.x + 100 / (a / w * std::cos(place.y * degree)) / degree, place.y),
      north(place.x, place.y + 100 / (a * (1 - e2) / (w * w * w)) / degree);
  for (const auto& [name, latitude, meridian] :
       {std::tuple("EPSG:3413", 70.0, -45.0), std::tuple("urn:ogc:def:crs:EPSG::3413", 70.0, -45.0),
        std::tuple("EPSG:3995", 71.0, 0.0)}) {
    const auto at = [&, latitude = latitude, meridian = meridian](const glm::dvec2& p) {
      return glm::dvec3(to_polar(p, latitude, meridian), 10);
    };
    const CityFrame frame = frame_of(name, {at(place)});
    const glm::dvec3 origin = project(frame, at(place));
    expect_near(glm::dvec2(project(frame, at(east)) - origin), {100, 0}, 0.02);
    expect_near(glm::dvec2(project(frame, at(north)) - origin), {0, 100}, 0.02);
    expect_near(frame.to_lon_lat(glm::dvec2(origin)), place, 1e-8);
    expect_near(frame.from_lon_lat(place), glm::dvec2(origin), 1e-3);
    EXPECT_NE(frame.description().find("north is none"), std::string::npos);
  }
  // The southern one, by symmetry: x and y are those of the north with latitude and y negated.
  const glm::dvec2 base(166.67, -77.85);  // McMurdo
  const glm::dvec2 mirrored = to_polar({base.x, -base.y}, 71, 0);
  const CityFrame south = frame_of("EPSG:3031", {{mirrored.x, -mirrored.y, 10}});
  expect_near(south.to_lon_lat(glm::dvec2(project(south, {mirrored.x, -mirrored.y, 10}))), base,
              1e-8);
}

// At longitude and latitude 0 the second axis through the earth's centre points east.
TEST(Frame, TheShiftThatADefinitionStatesIsTaken) {
  const CityFrame frame = frame_of(
      "+proj=tmerc +lat_0=0 +lon_0=0 +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +towgs84=0,100,0 "
      "+units=m +no_defs",
      {{0, 0, 0}});
  const double east = std::atan(100 / 6378137.0) * 180 / M_PI;
  expect_near(frame.to_lon_lat({0, 0}), {east, 0}, 1e-8);
  expect_near(frame.from_lon_lat({east, 0}), {0, 0}, 1e-3);
}

TEST(Frame, MetresUnderANameOfDegreesAreSaidToBeMetres) {
  try {
    frame_of("EPSG:4326", {{500100, 5427000, 200}});
    FAIL();
  } catch (const Error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("500100 5427000"), std::string::npos) << text;
    EXPECT_NE(text.find("not degrees"), std::string::npos) << text;
    EXPECT_NE(text.find("[city] crs"), std::string::npos) << text;
  }
}

TEST(Frame, JapaneseLatLonHeightKeepsHeightsAndDistances) {
  const Points sample{{34.65, 135.50, 12}};
  const CityFrame frame = frame_of("http://www.opengis.net/def/crs/EPSG/0/6697", sample);
  const glm::dvec3 a = project(frame, {34.65, 135.50, 12});
  // One minute north: meridian radius of GRS 80 at this latitude, a(1-e^2)/(1-e^2 sin^2)^1.5, times
  // the angle.
  const double e2 = 0.00669438002290, s = std::sin(34.6583333 * M_PI / 180);
  const double meridian = 6378137 * (1 - e2) / std::pow(1 - e2 * s * s, 1.5) * (M_PI / 180 / 60);
  const glm::dvec3 b = project(frame, {34.65 + 1.0 / 60, 135.50, 99});
  EXPECT_NEAR(b.y - a.y, meridian, 0.01);
  EXPECT_NEAR(b.x - a.x, 0, 0.01);
  EXPECT_EQ(a.z, 12);
  EXPECT_EQ(b.z, 99);
  // OSM arrives at the same place: JGD2011 and WGS 84 differ by nothing PROJ knows of.
  expect_near(frame.from_lon_lat({135.50, 34.65}), {a.x, a.y}, 1e-3);
  expect_near(frame.to_lon_lat({a.x, a.y}), {135.50, 34.65}, 1e-9);
}

TEST(Frame, LocalMercatorIsTheOneItsProjStringNames) {
  const CityFrame frame = frame_of("EPSG:4326", {{13.4, 52.5, 0}});
  ASSERT_NE(frame.crs().find("+proj=tmerc"), std::string::npos);
  const CityFrame named = frame_of("", {}, {.crs_override = frame.crs(), .control_points = {}});
  for (const glm::dvec2 p : {glm::dvec2{13.4, 52.5}, {13.5, 52.4}, {13.2, 52.7}})
    expect_near(frame.from_lon_lat(p), named.from_lon_lat(p), 1e-4);
}

TEST(Frame, FeetBecomeMetresInAllThreeAxes) {
  const CityFrame frame = frame_of("EPSG:2263", {{987830, 212283, 45}});
  constexpr double us_foot = 1200.0 / 3937.0;
  const glm::dvec3 p = project(frame, {987830, 212283, 45});
  EXPECT_NEAR(p.x, 987830 * us_foot, 1e-6);
  EXPECT_NEAR(p.y, 212283 * us_foot, 1e-6);
  EXPECT_NEAR(p.z, 45 * us_foot, 1e-9);
  EXPECT_NE(frame.crs().find("+units=m"), std::string::npos) << frame.crs();
  const glm::dvec2 lon_lat = frame.to_lon_lat({p.x, p.y});
  EXPECT_NEAR(lon_lat.x, -73.987, 0.01);
  EXPECT_NEAR(lon_lat.y, 40.749, 0.01);
  expect_near(frame.from_lon_lat(lon_lat), {p.x, p.y}, 1e-3);
}

// The register itself counts west and south there: a file that does so keeps its name's promise.
TEST(Frame, GridsThatCountWestAndSouthAreNoContradiction) {
  const CityFrame africa = frame_of("urn:ogc:def:crs:EPSG::2053",
                                    box_rings(94952.872, 2899340.048, 1500, 10)),
                  prague = frame_of("urn:ogc:def:crs:EPSG::5513",
                                    swapped(box_rings(743000, 1043000, 200, 10)));
  for (const CityFrame* frame : {&africa, &prague}) {
    EXPECT_EQ(frame->axis_warning(), "");
    EXPECT_NE(frame->description().find("in the EPSG register's order"), std::string::npos)
        << frame->description();
  }
  const glm::dvec3 place = project(africa, {94952.872, 2899340.048, 1500});
  expect_near(africa.to_lon_lat({place.x, place.y}), {28.05, -26.2}, 1e-6);
}

// Surveys that count longitudes from a capital's own observatory. The numbers are those of PROJ 9.1
// for the places; on the grids' central meridians they are 0 or the false easting in closed form.
TEST(Frame, GridsCountFromTheirOwnPrimeMeridian) {
  struct Case {
    const char* name;
    glm::dvec2 numbers, lon_lat;
  };
  constexpr double oslo = 10 + 43 / 60.0 + 22.5 / 3600, ferro = -(17 + 40 / 60.0);
  for (const Case& c :
       {Case{"urn:ogc:def:crs:EPSG::2065", {1042721.363, 742860.083}, {14.42, 50.09}},
        Case{"urn:ogc:def:crs:EPSG::5221", {-499143.412, -1192339.990}, {18, 49}},
        Case{"urn:ogc:def:crs:EPSG::20790", {112430.662, 195205.647}, {-9.14, 38.72}},
        Case{"urn:ogc:def:crs:EPSG::27393", {212654.013, 1785.214}, {10.75, 59.91}},
        Case{"urn:ogc:def:crs:EPSG::27393", {212654.013, 0}, {oslo, 59.91}},
        Case{"urn:ogc:def:crs:EPSG::26591", {541417.859, 5107820.927}, {9.19, 45.46}},
        Case{"urn:ogc:def:crs:EPSG::31253", {341289.389, 2814.281}, {16.37, 48.21}},
        Case{"urn:ogc:def:crs:EPSG::31253", {341289.389, 0}, {34 + ferro, 48.21}},
        Case{"urn:ogc:def:crs:EPSG::27572", {997942.494, 1867846.499}, {7.27, 43.70}},
        Case{"urn:ogc:def:crs:EPSG::4807", {54.27785471, 0.01499310}, {2.35, 48.85}},
        Case{"urn:ogc:def:crs:EPSG::4807", {48.55552924, 5.48138381}, {7.27, 43.70}}}) {
    const glm::dvec3 numbers(c.numbers, 100);
    const CityFrame frame = frame_of(c.name, {numbers});
    EXPECT_EQ(frame.axis_warning(), "") << c.name;
    const glm::dvec2 place(project(frame, numbers));
    // Datums of other centuries lie up to 300 m from WGS 84, and their shifts back within 5 mm.
    expect_near(frame.to_lon_lat(place), c.lon_lat, 5e-3);
    expect_near(frame.from_lon_lat(frame.to_lon_lat(place)), place, 5e-3);
    EXPECT_EQ(frame.crs().find("+axis"), std::string::npos) << frame.crs();
  }
}

// The old observatory of Bern, of which the grid of 1898 counts. Its degrees begin there too, and
// its shift to WGS 84 leads through the later Swiss datum (swisstopo: 46d 57' 3.8986", 7d 26'
// 19.0766"); without it places lay 170 m off.
TEST(Frame, AShiftThroughALaterDatumIsBetterThanNone) {
  const CityFrame frame = frame_of("urn:ogc:def:crs:EPSG::21780", {{0, 0, 500}});
  expect_near(frame.to_lon_lat({0, 0}), {7.43863, 46.95108}, 3e-5);
  EXPECT_EQ(frame.axis_warning(), "");
  // PROJ knows the shift at Milan from Rome's datum in degrees alone. It is that of the same datum
  // counted from Greenwich.
  const CityFrame rome = frame_of("EPSG:4806", {{9.19 - 12.4523333, 45.46, 0}}),
                  greenwich = frame_of("EPSG:4265", {{9.19, 45.46, 0}});
  const glm::dvec2 place(9.19, 45.46);
  expect_near(rome.from_lon_lat(place), greenwich.from_lon_lat(place), 0.01);
}

TEST(Frame, ADatumOfUnknownShiftIsToldUnlessSatellitesMadeIt) {
  const CityFrame old = frame_of("EPSG:2040", {{500000, 800000, 0}});
  EXPECT_NE(old.axis_warning().find("60 to 460 m"), std::string::npos) << old.axis_warning();
  EXPECT_EQ(frame_of("EPSG:22212", {{500000, 7000000, 0}}).axis_warning(), "");
}

// PROJ finds Minna in Nigeria by "n/a", Amersfoort by "foo" and Hong Kong by "GK".
TEST(Frame, APartOfANameIsNoName) {
  for (const char* name : {"n/a", "foo", "GK", "Beijing", "KOREA"})
    EXPECT_THROW(frame_of(name, {{8, 9, 0}}), Error) << name;
  for (const char* name : {"LV95", "CH1903+ / LV95", "CH1903+_LV95", "ch1903+/lv95"})
    expect_near(frame_of(name, {{2600000, 1200000, 0}}).to_lon_lat({2600000, 1200000}),
                {7.43863, 46.95108}, 3e-5);
  EXPECT_NO_THROW(frame_of("ETRS_1989_UTM_Zone_32N", {{691928, 5335080, 0}}));
  EXPECT_NO_THROW(frame_of("NZTM", {{1749000, 5428000, 0}})) << "one CRS alone has it";
  EXPECT_NO_THROW(frame_of("British National Grid", {{531979, 179606, 0}}));
  EXPECT_NO_THROW(frame_of("ETRS89 / UTM zone 32N + DHHN2016 height", {{691928, 5335080, 0}}));
}

// A grad is nine tenths of a degree: a thousandth is 100 m of a meridian, by the metre's own
// definition; on Clarke's ellipsoid of 1880 at 48.85 degrees it is 100.08 m.
TEST(Frame, GradsAreNoDegrees) {
  const glm::dvec3 a(54.277, 0.015, 0), b(54.278, 0.015, 0);
  const CityFrame frame = frame_of("urn:ogc:def:crs:EPSG::4807", {a});
  EXPECT_NEAR(project(frame, b).y - project(frame, a).y, 100.08, 0.02);
}

TEST(Frame, KrovakInSouthAndWestIsTurned) {
  // Prague: EPSG:5514 east, north is about (-743000, -1043000); old files hold the positive
  // numbers.
  const CityFrame frame = frame_of("EPSG:5514", {{743000, 1043000, 200}});
  EXPECT_EQ(project(frame, {743000, 1043000, 200}), glm::dvec3(-743000, -1043000, 200));
  const glm::dvec2 lon_lat = frame.to_lon_lat({-743000, -1043000});
  EXPECT_NEAR(lon_lat.x, 14.4, 0.2);
  EXPECT_NEAR(lon_lat.y, 50.1, 0.2);
}

TEST(Frame, CoordinatesOutsideTheAreaOfUseAreAnErrorThatNamesTheWayOut) {
  try {
    frame_of("EPSG:28992", {{12.5, 41.9, 3}});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("area of use"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("[city] crs"), std::string::npos);
  }
  // A recipe may insist, and is warned.
  const CityFrame insisted = frame_of("EPSG:28992", {{12.5, 41.9, 3}},
                                      {.crs_override = "EPSG:28992", .control_points = {}});
  EXPECT_NE(insisted.axis_warning().find("area of use"), std::string::npos);
}

TEST(Frame, UnknownNameIsAnErrorAndNotANumber) {
  for (const char* name :
       {"WB3_local", "EPSG:999999", "urn:ogc:def:crs:EPSG::5101", "garbage\x01", "EPSG:4978"})
    EXPECT_THROW(frame_of(name, {{1, 2, 3}}), Error) << name;
}

TEST(Frame, NoNamePassesCoordinatesThroughAndRefusesLonLat) {
  const CityFrame frame = frame_of("", {{1, 2, 3}});
  EXPECT_EQ(project(frame, {1, 2, 3}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(frame.crs(), "");
  EXPECT_FALSE(frame.has_lon_lat());
  EXPECT_THROW(frame.from_lon_lat({13, 52}), Error);
  EXPECT_THROW(frame.to_lon_lat({1, 2}), Error);
  EXPECT_FALSE(frame_of("EPSG:25833", {{1, 2, 3}}, {.crs_override = "none", .control_points = {}})
                   .has_lon_lat());
}

TEST(Frame, ControlPointsPlaceAModelWithoutCrs) {
  // The model has UTM coordinates turned by 30 degrees and moved; two points suffice to find the
  // turn.
  const CityFrame utm = frame_of("EPSG:25833", {});
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  const auto model = [&](glm::dvec2 lon_lat) {
    const glm::dvec2 d = utm.from_lon_lat(lon_lat) - utm.from_lon_lat({15.0, 52.5});
    return glm::dvec2{100 + c * d.x - s * d.y, 200 + s * d.x + c * d.y};
  };
  const glm::dvec2 p{14.99, 52.49}, q{15.01, 52.51}, between{15.002, 52.503};
  const CityFrame frame =
      frame_of("", {}, {.crs_override = "", .control_points = {{p, model(p)}, {q, model(q)}}});
  EXPECT_TRUE(frame.has_lon_lat());
  expect_near(frame.from_lon_lat(between), model(between), 0.01);
  expect_near(frame.to_lon_lat(model(between)), between, 1e-7);
  EXPECT_THROW(frame_of("", {}, {.crs_override = "", .control_points = {{p, {1, 1}}, {p, {1, 1}}}}),
               Error);
}

TEST(Frame, BrokenCoordinatesAnswerNanAndNeverThrow) {
  const CityFrame frame =
      frame_of("http://www.opengis.net/def/crs/EPSG/0/6697", {{34.65, 135.5, 0}});
  EXPECT_TRUE(std::isnan(project(frame, {1e300, 135, 0}).x));
  EXPECT_TRUE(std::isnan(project(frame, {NAN, NAN, 0}).x));
  EXPECT_TRUE(std::isnan(frame.from_lon_lat({NAN, 0}).x));
  EXPECT_TRUE(std::isnan(frame.from_lon_lat({0, 1e9}).x));
}

TEST(Frame, OperationOfTheBestStatedAccuracyAtThePlaceIsTaken) {
  // Four operations lead from WGS 84 to the Czech grid: one for all of former Czechoslovakia (6 m),
  // others of 1 m.
  const CityFrame prague = frame_of("EPSG:5514", {{-743000, -1043000, 200}});
  EXPECT_NE(prague.description().find("accuracy 1 m"), std::string::npos) << prague.description();
}

TEST(Frame, DescriptionStatesOperationAndAccuracy) {
  const CityFrame frame = frame_of("EPSG:28992", {{92000, 437000, 0}});
  EXPECT_NE(frame.description().find("accuracy"), std::string::npos) << frame.description();
  EXPECT_NE(frame.description().find("axes"), std::string::npos);
}

// A file that a stranger wrote must not choose what is opened here, a FIFO say.
TEST(Frame, ADefinitionOfAFileOpensNoOtherFile) {
  const test::TempFolder folder;
  const std::string other = (folder / "other").string();
  test::write_text(other, "no grid");
  const auto error_of = [](const std::string& srs, const CityFrame::Options& options) {
    try {
      frame_of(srs, {{391000, 5819000, 30}}, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::string& srs :
       {"+init=" + other + ":1", "+proj=pipeline +step +proj=vgridshift +grids=" + other,
        "+proj=utm +zone=33 +ellps=GRS80 +nadgrids=" + other + " +type=crs"})
    EXPECT_NE(error_of(srs, {}).find("names the file \"" + other), std::string::npos) << srs;
  const std::string by_recipe = error_of("", {"+init=" + other + ":1", {}});
  EXPECT_EQ(by_recipe.find("names the file"), std::string::npos) << by_recipe;
}

TEST(Frame, DegreesThatAreRoundedToAMetreAreTold) {
  const auto rounded = [](Points points, double step) {
    for (glm::dvec3& p : points)
      p.x = std::round(p.x / step) * step, p.y = std::round(p.y / step) * step;
    return points;
  };
  const Points house = box_rings(35.6812345678, 139.7671234567, 3, 1e-4);
  const std::string name = "http://www.opengis.net/def/crs/EPSG/0/6697";
  EXPECT_EQ(frame_of(name, house).axis_warning(), "");
  EXPECT_EQ(frame_of(name, rounded(house, 1e-7)).axis_warning(), "");
  for (const double step : {1e-3, 1e-4, 1e-5})
    EXPECT_NE(frame_of(name, rounded(house, step)).axis_warning().find("five decimals"),
              std::string::npos)
        << step;
  // Metres may well be whole.
  EXPECT_EQ(frame_of("EPSG:25833", box_rings(391000, 5820000, 30, 10)).axis_warning(), "");
}

}  // namespace
}  // namespace nightcity::georeference
