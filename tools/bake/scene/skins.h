// Finishes of buildings to which neither model nor map gives a colour: one table of what walls and
// roofs are covered with, by use and age, and a draw from it that the building's id alone decides.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "tools/city/city_model.h"
#include "tools/lights/building_use.h"

namespace nightcity::bake {

enum class Finish : std::uint8_t {
  plaster,
  brick,
  stone,
  concrete,
  painted_sheet,
  tiles,
  tar_and_gravel,
  iron_sheet,
  count
};

/// A finish has few shades. Each stands for the same share of the range of its reflectance, and
/// is a material, and a primitive in each tile where it is.
struct FinishRow {
  const char* name;
  float min_reflectance, max_reflectance;  // diffuse, of visible light
  std::span<const glm::vec3> tints;        // of each shade, the darkest first: linear Rec. 709
};
const FinishRow& find_finish(Finish finish);

/// One shade of a finish.
struct Skin {
  Finish finish = Finish::plaster;
  std::uint8_t shade = 0;
  auto operator<=>(const Skin&) const = default;
};
/// Returns the middle of the shade's share of the range.
float find_reflectance(Skin skin);

enum class Age : std::uint8_t { unknown, before_1919, from_1919, from_1949, from_1979, count };
/// "before 1919", ...: the names used in reports.
const char* name_of(Age age);
/// Returns the age for a year of construction, as city models write it. A text that is no number
/// from 1000 to 2100 says nothing.
Age find_age(const std::string& year);

enum class SkinPart : std::uint8_t { walls, pitched_roof, flat_roof, count };
constexpr std::size_t finish_choices = 4;
/// Returns the finishes of the part, each of them equally often.
std::span<const Finish, finish_choices> list_finishes(SkinPart part, lights::BuildingUse use,
                                                      Age age);

/// The skin of each part of a building.
struct BuildingSkin {
  std::array<Skin, static_cast<std::size_t>(SkinPart::count)> of_part;
  Skin of(SkinPart part) const { return of_part[static_cast<std::size_t>(part)]; }
};
/// `key`: a hash of the building's id, which alone decides among the finishes and their shades.
BuildingSkin draw_skin(std::uint64_t key, lights::BuildingUse use, Age age);

}  // namespace nightcity::bake
