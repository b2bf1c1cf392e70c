#include "formats/hierarchy/cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/hierarchy/cutting_build.h"

namespace nightcity::hierarchy {
namespace {

bool is_in(const Bounds& box, const glm::dvec3& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < double(box.lower[axis]) || p[axis] > double(box.upper[axis])) return false;
  return true;
}

glm::dvec3 to_double(Float4 p) {
  return {double(p[0]), double(p[1]), double(p[2])};
}

class RandomPlaces {
 public:
  explicit RandomPlaces(unsigned seed) : random_(seed) {}
  float operator()(float from, float to) {
    return from + (to - from) * float(random_() >> 8) / 16777216.0f;
  }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(random_() % count); }
  Float4 point(float size) {
    const float x = (*this)(-size, size), y = (*this)(-size, size);
    return Float4{x, y, (*this)(-size, size), 0};
  }
  glm::dvec3 on(const Corners& triangle) {
    double u = (*this)(0, 1), v = (*this)(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const glm::dvec3 a = to_double(triangle.v0);
    return a + u * (to_double(triangle.v1) - a) + v * (to_double(triangle.v2) - a);
  }

 private:
  std::mt19937 random_;
};

std::span<const std::byte> cut_bytes(const std::vector<Cut>& cuts) {
  return std::as_bytes(std::span(cuts));
}

// The legs of a right triangle are 10 m long; at 4 m its other side is 6 m high.
TEST(CutBox, IsThatOfEachSide) {
  const Corners triangle{{0, 0, 5, 0}, {10, 0, 5, 0}, {0, 10, 5, 0}};
  const auto halves = cut_box(triangle, triangle.bounds(), 0, 4);
  ASSERT_TRUE(halves);
  const auto expect_box = [](const Bounds& box, const glm::vec3& lower, const glm::vec3& upper) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(box.lower[axis], lower[axis], 4e-6f);
      EXPECT_NEAR(box.upper[axis], upper[axis], 4e-6f);
    }
  };
  expect_box(halves->first, {0, 0, 5}, {4, 10, 5});
  expect_box(halves->second, {4, 0, 5}, {10, 6, 5});
  const auto quarters = cut_box(triangle, halves->second, 1, 2);
  ASSERT_TRUE(quarters) << "a part is cut again";
  expect_box(quarters->first, {4, 0, 5}, {10, 2, 5});
  expect_box(quarters->second, {4, 2, 5}, {8, 6, 5});
}

TEST(CutBox, IsNoneBesideAPart) {
  const Corners triangle{{0, 0, 5, 0}, {10, 0, 5, 0}, {0, 10, 5, 0}};
  for (const auto& [axis, plane_m] :
       std::vector<std::pair<int, float>>{{0, -1.f}, {0, 0.f}, {0, 10.f}, {1, 11.f}, {2, 5.f}})
    EXPECT_FALSE(cut_box(triangle, triangle.bounds(), axis, plane_m)) << axis << ' ' << plane_m;
}

// However often triangles are cut, and wherever they lie: no point of them is outside all parts, and
// no part is outside the one that it was cut from.
TEST(CutBox, PartsHoldAllOfATriangle) {
  RandomPlaces random(5);
  for (int round = 0; round < 300; ++round) {
    const float size = std::pow(10.0f, random(-1, 4)), far = random(0, 1) < 0.5f ? 0 : 1e5f;
    const Float4 place = random.point(far);
    const Corners triangle{place + random.point(size), place + random.point(size),
                           place + random.point(size)};
    std::vector<Bounds> parts{triangle.bounds()};
    for (int k = 0; k < 12; ++k) {
      const std::size_t part = random.below(static_cast<std::uint32_t>(parts.size()));
      const Bounds whole = parts[part];
      const int axis = static_cast<int>(random.below(3));
      const auto halves =
          cut_box(triangle, whole, axis, random(whole.lower[axis], whole.upper[axis]));
      if (!halves) continue;
      parts[part] = halves->first;
      parts.push_back(halves->second);
      for (const Bounds& half : {halves->first, halves->second})
        for (int a = 0; a < 3; ++a) {
          ASSERT_GE(half.lower[a], whole.lower[a]);
          ASSERT_LE(half.upper[a], whole.upper[a]);
        }
    }
    EXPECT_GT(parts.size(), 1u);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 point = random.on(triangle);
      ASSERT_TRUE(std::any_of(parts.begin(), parts.end(), [&](const Bounds& part) {
        return is_in(part, point);
      })) << round;
    }
  }
}

TEST(Cuts, AreReadAsTheyWereWritten) {
  const std::vector<Cut> written{{7, 0, 1.5f}, {20, 2, -3.0f}, {3, 1, 0.0f}};
  std::vector<Cut> cuts;
  EXPECT_EQ(decode_cuts(cut_bytes(written), 20, cuts), "");
  ASSERT_EQ(cuts.size(), 3u);
  EXPECT_EQ(cuts[1].part, 20u);
  EXPECT_EQ(cuts[1].axis, 2u);
  EXPECT_EQ(cuts[1].plane_m, -3.0f);
  EXPECT_EQ(decode_cuts({}, 20, cuts), "");
  EXPECT_TRUE(cuts.empty());
}

TEST(Cuts, OfNoPartOrPlaneAreRefused) {
  const auto refusal_of = [](const std::vector<Cut>& cuts, std::uint32_t triangles = 20) {
    std::vector<Cut> read;
    return decode_cuts(cut_bytes(cuts), triangles, read);
  };
  EXPECT_NE(refusal_of({{20, 0, 1}}).find("not there"), std::string::npos);
  EXPECT_NE(refusal_of({{1, 0, 1}, {22, 0, 1}}).find("not there"), std::string::npos);
  EXPECT_NE(refusal_of({{1, 0, 1}, {1, 0, 2}}).find("twice"), std::string::npos);
  EXPECT_NE(refusal_of({{1, 3, 1}}).find("no plane"), std::string::npos);
  EXPECT_NE(refusal_of({{1, 0, NAN}}).find("no plane"), std::string::npos);
  EXPECT_NE(refusal_of({{0, 0, 1}, {1, 0, 1}}, 1).find("more cuts"), std::string::npos);
  EXPECT_NE(refusal_of({{0, 0, 1}}, std::uint32_t(most_parts) - 1).find("too many parts"),
            std::string::npos);
  std::vector<Cut> read;
  EXPECT_NE(decode_cuts(cut_bytes({{1, 0, 1}}).first(5), 20, read).find("within one"),
            std::string::npos);
}

// Long triangles that cross each other at any angle, as streets do, and small ones between them.
CutPieces make_streets(std::uint32_t count, unsigned seed) {
  RandomPlaces random(seed);
  std::vector<Corners> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float angle = random(0, 3.14f), half = i % 4 == 0 ? random(20, 150) : random(0.1f, 2);
    const Float4 middle{random(-500, 500), random(0, 10), random(-500, 500), 0},
        way{half * std::cos(angle), 0, half * std::sin(angle), 0},
        across{3 * std::sin(angle), 0, -3 * std::cos(angle), 0};
    triangles.push_back({middle - way, middle + way, middle + way + across});
  }
  CutPieces pieces;
  std::vector<TrianglePiece> made;
  append_pieces(triangles, true, 0, {}, made, &pieces.large);
  pieces.pieces.assign(made.begin(), made.end());
  return pieces;
}

TEST(CuttingBuild, KeepsBoxesOfLongTrianglesApart) {
  constexpr std::uint32_t count = 20'000;
  double area_m2 = 0, whole_m2 = 0;
  const Encoded encoded = build_encoded(make_streets(count, 1), count, 2, area_m2);
  EXPECT_GT(encoded.cuts.size(), count / 20);
  EXPECT_LE(encoded.cuts.size(), find_room(count));
  LargeVector<TrianglePiece> whole = make_streets(count, 1).pieces;
  for (TrianglePiece& piece : whole) piece = TrianglePiece(piece.bounds(), piece.first(), 1);
  LargeVector<BareNode> nodes;
  ParallelBuild<PieceAccess<2>, BareNodes>(std::span(whole), 4, 2, nodes).build(0, 46);
  for (const BareNode& node : nodes) whole_m2 += double(node.area);
  EXPECT_LT(area_m2, 0.8 * whole_m2);

  std::vector<Cut> cuts;
  ASSERT_EQ(decode_cuts(cut_bytes(encoded.cuts), count, cuts), "");
  const auto positions = static_cast<std::uint32_t>(count + cuts.size());
  Topology topology;
  ASSERT_EQ(decode_topology(std::as_bytes(std::span(encoded.topology)), positions, 4, 46, topology),
            "");
  std::vector<std::uint32_t> order(positions);
  EXPECT_EQ(decode_order(std::as_bytes(std::span(encoded.order)), 0, order, cuts), "");
}

TEST(CuttingBuild, IsTheSameForAnyNumberOfThreads) {
  constexpr std::uint32_t count = 150'000;  // several tasks
  double area_of_one = 0, area_of_many = 0;
  const Encoded one = build_encoded(make_streets(count, 2), count, 1, area_of_one),
                many = build_encoded(make_streets(count, 2), count, 7, area_of_many);
  EXPECT_EQ(one.topology, many.topology);
  EXPECT_EQ(one.order, many.order);
  ASSERT_EQ(one.cuts.size(), many.cuts.size());
  EXPECT_TRUE(std::ranges::equal(cut_bytes(one.cuts), cut_bytes(many.cuts)));
  EXPECT_EQ(area_of_one, area_of_many);
}

}  // namespace
}  // namespace nightcity::hierarchy
