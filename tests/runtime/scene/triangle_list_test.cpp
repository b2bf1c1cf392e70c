#include "runtime/scene/triangle_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace nightcity::scene {
namespace {

// Four vertices of a square, as a file holds them, and two triangles.
struct Square {
  std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  std::vector<float> features{2, 2, 8, 8}, lights{-1, -1, 5, 5};
  std::vector<std::uint8_t> bytes{0, 1, 2, 2, 3, 0};
  std::vector<std::uint16_t> shorts{0, 1, 2, 2, 3, 0};
  std::vector<std::uint32_t> words{0, 1, 2, 2, 3, 0};

  template <class T>
  static MappedPrimitive::Array array_of(const std::vector<T>& values) {
    return {reinterpret_cast<const std::byte*>(values.data()), sizeof(T)};
  }
  template <class T>
  MappedPrimitive mapped(const std::vector<T>& indices) const {
    MappedPrimitive primitive;
    primitive.positions = array_of(positions);
    primitive.features = array_of(features);
    primitive.lights = array_of(lights);
    primitive.indices = array_of(indices);
    primitive.index_bytes = sizeof(T);
    primitive.vertices = 4;
    primitive.triangles = 2;
    primitive.material = 7;
    primitive.first_feature = 100;
    primitive.feature_count = 9;
    primitive.null_feature = 8;
    return primitive;
  }
};

gpu::Triangle numbered(std::uint32_t material) {
  gpu::Triangle triangle{};
  triangle.material = material;
  return triangle;
}

bool same(const gpu::Triangle& a, const gpu::Triangle& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(TriangleList, ReadsTrianglesWhereTheyLie) {
  const Square square;
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.5, glm::dvec3(0, 1, 0));
  for (const glm::dmat4& to_scene :
       {glm::dmat4(1), glm::translate(glm::dmat4(1), glm::dvec3(1e5, 0.1, -3)), turned}) {
    for (const MappedPrimitive& primitive :
         {square.mapped(square.bytes), square.mapped(square.shorts), square.mapped(square.words)}) {
      TriangleList list;
      list.append(std::make_shared<MappedPrimitive>(primitive), to_scene);
      ASSERT_EQ(list.size(), 2u);
      const auto place = [&](int vertex) {
        return glm::vec3(to_scene *
                         glm::dvec4(square.positions[static_cast<std::size_t>(vertex)], 1));
      };
      EXPECT_EQ(list[0].v0, place(0));
      EXPECT_EQ(list[0].v1, place(1));
      EXPECT_EQ(list[0].v2, place(2));
      EXPECT_EQ(list[1].v0, place(2));
      EXPECT_EQ(list[1].v2, place(0));
      EXPECT_EQ(list[0].material, 7u);
      EXPECT_EQ(list[0].feature, 102u);
      EXPECT_EQ(list[0].light, NO_HIT);
      EXPECT_EQ(list[1].feature, NO_HIT);  // the null feature
      EXPECT_EQ(list[1].light, 5u);
    }
  }
}

// Floats are added where their frame is moved by floats; a sum of doubles, rounded, is the same.
TEST(TriangleList, PlacesTrianglesByFloatsAsByDoubles) {
  std::mt19937 random(1);
  const auto draw = [&] {
    const float sign = random() % 2 ? 1 : -1;
    return sign * std::ldexp(1 + float(random()) / 0x1p32f, int(random() % 60) - 30);
  };
  for (int run = 0; run < 100; ++run) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 300; ++i) corners.emplace_back(draw(), draw(), draw());
    const glm::vec3 shift(draw(), draw(), draw());
    MappedPrimitive primitive;
    primitive.positions = Square::array_of(corners);
    primitive.vertices = 300;
    primitive.triangles = 100;
    TriangleList list;
    list.append(std::make_shared<MappedPrimitive>(primitive),
                glm::translate(glm::dmat4(1), glm::dvec3(shift)));
    for (std::size_t i = 0; i < 100; ++i)
      ASSERT_EQ(list[i].v1, glm::vec3(glm::dvec3(corners[3 * i + 1]) + glm::dvec3(shift))) << i;
  }
}

// Blocks of all lengths, stored and mapped, in one list: each triangle is found by its number, and
// copies begin and end anywhere.
TEST(TriangleList, FindsTrianglesInBlocksOfBothKinds) {
  const Square square;
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 3000; ++i) corners.emplace_back(float(i), float(i % 7), 0);
  TriangleList list;
  std::vector<gpu::Triangle> expected;
  std::uint32_t count = 0;
  for (std::uint32_t block = 0; block < 60; ++block) {
    const std::uint32_t size = 1 + block * block % 900;
    if (block % 3 == 0) {
      for (std::uint32_t i = 0; i < size; ++i) expected.push_back(numbered(count++));
      list.append(std::span(expected).last(size));
    } else {
      MappedPrimitive primitive;
      primitive.positions = Square::array_of(corners);
      primitive.vertices = 3000;
      primitive.triangles = size;
      primitive.material = block;
      list.append(std::make_shared<MappedPrimitive>(primitive), glm::dmat4(1));
      for (std::size_t i = 0; i < size; ++i)
        expected.push_back(
            {corners[3 * i], block, corners[3 * i + 1], NO_HIT, corners[3 * i + 2], NO_HIT});
    }
  }
  ASSERT_EQ(list.size(), expected.size());
  std::size_t at = 0;
  for (const gpu::Triangle& triangle : list) ASSERT_TRUE(same(triangle, expected[at++])) << at;
  for (const std::size_t first : {std::size_t{0}, std::size_t{1}, std::size_t{4711}}) {
    std::vector<hierarchy::Corners> copied(list.size() - first - 3);
    list.copy_corners(first, copied);
    for (std::size_t i = 0; i < copied.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(copied[i].v0[axis], expected[first + i].v0[axis]) << i;
        ASSERT_EQ(copied[i].v1[axis], expected[first + i].v1[axis]) << i;
        ASSERT_EQ(copied[i].v2[axis], expected[first + i].v2[axis]) << i;
      }
  }
  std::vector<std::uint32_t> numbers(list.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(1));
  std::vector<gpu::Triangle> gathered(numbers.size());
  std::vector<hierarchy::Bounds> measured(numbers.size()), turned(numbers.size());
  hierarchy::Bounds all, all_turned;
  list.gather(numbers, gathered);
  list.measure(numbers, {}, measured, all);
  const hierarchy::BoxFrame quarter{{0, 1}};  // its x is z, and its z is -x
  list.measure(numbers, quarter, turned, all_turned);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const gpu::Triangle& triangle = expected[numbers[i]];
    ASSERT_TRUE(same(gathered[i], triangle)) << i;
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(measured[i].lower[axis],
                std::min({triangle.v0[axis], triangle.v1[axis], triangle.v2[axis]}));
      ASSERT_EQ(measured[i].upper[axis],
                std::max({triangle.v0[axis], triangle.v1[axis], triangle.v2[axis]}));
      ASSERT_LE(all.lower[axis], measured[i].lower[axis]);
      ASSERT_GE(all.upper[axis], measured[i].upper[axis]);
      ASSERT_EQ(all.lower[axis], all_turned.lower[axis]);
      ASSERT_EQ(all.upper[axis], all_turned.upper[axis]);
    }
    ASSERT_EQ(turned[i].lower[0], measured[i].lower[2]);
    ASSERT_EQ(turned[i].upper[1], measured[i].upper[1]);
    ASSERT_EQ(turned[i].lower[2], -measured[i].upper[0]);
  }
  EXPECT_TRUE(list.any_material([](std::uint32_t material) { return material == 58; }));
  EXPECT_FALSE(list.any_material([&](std::uint32_t material) { return material == count; }));
}

// Another program may have rewritten the file since it was checked.
TEST(TriangleList, StaysWithinItsArraysWhateverTheyHoldNow) {
  Square square;
  square.words = {4, 0xFFFFFFFF, 2, 0, 0, 0};
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  square.features = {9, -1, 1e30f, nan};
  square.lights = {nan, -5, 1e30f, 3e9f};
  TriangleList list;
  list.append(std::make_shared<MappedPrimitive>(square.mapped(square.words)), glm::dmat4(1));
  EXPECT_EQ(list[0].v0, square.positions[3]);
  EXPECT_EQ(list[0].v1, square.positions[3]);
  for (const gpu::Triangle& triangle : list) {
    EXPECT_EQ(triangle.feature, NO_HIT);
    EXPECT_EQ(triangle.light, NO_HIT);
  }
}

}  // namespace
}  // namespace nightcity::scene
