#include "tools/bake/scene/skins.h"

#include <charconv>

#include "tools/random.h"

namespace nightcity::bake {
namespace {

using enum Finish;

// Reflectances: T. R. Oke, Boundary Layer Climates, 2nd ed. (1987), tables 1.1 and 8.2: the whole
// of a range, except for plaster. It is painted in all shades from the palest that is called
// coloured (red, brown, green paint 0.20-0.35) to white that has aged (new 0.50-0.90): 0.35-0.65 is
// an assumption. Tints are assumptions too, as those of bake_materials().
template <std::size_t shades>
using Tints = std::array<glm::vec3, shades>;
constexpr Tints<3> painted{{{1.0f, 0.84f, 0.60f}, {1.0f, 0.96f, 0.88f}, {1.0f, 0.93f, 0.78f}}};
constexpr Tints<2> burnt_clay{{{1.0f, 0.50f, 0.36f}, {1.0f, 0.64f, 0.47f}}},
    sandy{{{1.0f, 0.88f, 0.70f}, {1.0f, 0.97f, 0.88f}}},
    warm_grey{{{1.0f, 0.98f, 0.95f}, {1.0f, 0.98f, 0.95f}}},
    coated{{{0.80f, 0.92f, 1.0f}, {1.0f, 1.0f, 1.0f}}};
constexpr Tints<1> grey{{{1.0f, 1.0f, 1.0f}}};

constexpr std::array<FinishRow, static_cast<std::size_t>(count)> finishes{{
    {"plaster", 0.35f, 0.65f, painted},
    {"brick", 0.20f, 0.40f, burnt_clay},
    {"stone", 0.20f, 0.35f, sandy},
    {"concrete", 0.10f, 0.35f, warm_grey},
    {"painted sheet", 0.20f, 0.35f, coated},  // red, brown, green paint
    {"tiles", 0.10f, 0.35f, burnt_clay},
    {"tar and gravel", 0.08f, 0.18f, grey},
    {"iron sheet", 0.10f, 0.16f, grey},  // corrugated iron
}};

// Groups of uses whose buildings look alike.
enum class UseGroup : std::uint8_t { dwellings, business, institutions, industry, other, count };

constexpr std::size_t age_count = static_cast<std::size_t>(Age::count);
using Finishes = std::array<Finish, finish_choices>;

// The shares of the finishes are an assumption, in quarters, for want of statistics that hold for
// more than one region. In short: houses are plastered, brick and stone are of the time before
// 1919, concrete is of the decades after 1949, and halls are clad in sheet since 1979.
constexpr std::array<std::array<Finishes, age_count>, static_cast<std::size_t>(UseGroup::count)>
    walls{{
        {{{plaster, plaster, plaster, brick},         // dwellings of unknown age
          {plaster, plaster, brick, brick},           // before 1919
          {plaster, plaster, plaster, brick},         // 1919 to 1948
          {plaster, plaster, plaster, concrete},      // 1949 to 1978
          {plaster, plaster, plaster, brick}}},       // from 1979
        {{{plaster, stone, concrete, painted_sheet},  // business
          {plaster, brick, stone, stone},
          {plaster, plaster, brick, stone},
          {plaster, stone, concrete, concrete},
          {plaster, stone, concrete, painted_sheet}}},
        {{{plaster, brick, stone, concrete},  // institutions
          {plaster, brick, brick, stone},
          {plaster, plaster, brick, stone},
          {plaster, brick, concrete, concrete},
          {plaster, plaster, brick, concrete}}},
        {{{brick, concrete, painted_sheet, painted_sheet},  // industry
          {brick, brick, brick, brick},
          {brick, brick, brick, concrete},
          {brick, concrete, concrete, painted_sheet},
          {concrete, painted_sheet, painted_sheet, painted_sheet}}},
        {{{plaster, plaster, brick, concrete},  // other: garages, sheds, churches
          {plaster, brick, stone, stone},
          {plaster, plaster, brick, brick},
          {plaster, plaster, concrete, concrete},
          {plaster, concrete, concrete, painted_sheet}}},
    }};

constexpr Finishes tiled{tiles, tiles, tiles, tiles},
    metal{iron_sheet, iron_sheet, iron_sheet, iron_sheet},
    half_metal{tiles, tiles, iron_sheet, iron_sheet},
    flat{tar_and_gravel, tar_and_gravel, tar_and_gravel, tar_and_gravel};

UseGroup find_group(lights::BuildingUse use) {
  using enum lights::BuildingUse;
  switch (use) {
    case residential:
    case mixed:
    case hotel:
      return UseGroup::dwellings;
    case office:
    case retail:
      return UseGroup::business;
    case education:
    case civic:
      return UseGroup::institutions;
    case industrial:
      return UseGroup::industry;
    case dark:
      break;
  }
  return UseGroup::other;
}

// Halls have metal roofs since there are large sheets of it: an assumption, as for walls.
const Finishes& find_pitched_roof(UseGroup group, Age age) {
  if (group != UseGroup::industry) return tiled;
  return age == Age::before_1919 || age == Age::from_1919 ? tiled
         : age == Age::unknown                            ? half_metal
                                                          : metal;
}

}  // namespace

const FinishRow& find_finish(Finish finish) {
  return finishes[static_cast<std::size_t>(finish)];
}

float find_reflectance(Skin skin) {
  const FinishRow& row = find_finish(skin.finish);
  const float share =
      (static_cast<float>(skin.shade) + 0.5f) / static_cast<float>(row.tints.size());
  return row.min_reflectance + share * (row.max_reflectance - row.min_reflectance);
}

const char* name_of(Age age) {
  constexpr const char* names[] = {"unknown", "before 1919", "1919 to 1948", "1949 to 1978",
                                   "from 1979"};
  return names[static_cast<std::size_t>(age)];
}

// The borders are among those of the ages in the German typology of dwellings (T. Loga et al.,
// Deutsche Wohngebäudetypologie, 2nd ed., IWU 2015).
Age find_age(const std::string& text) {
  int year = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, year);
  if (error != std::errc() || end != last || year < 1000 || year > 2100) return Age::unknown;
  return year < 1919   ? Age::before_1919
         : year < 1949 ? Age::from_1919
         : year < 1979 ? Age::from_1949
                       : Age::from_1979;
}

std::span<const Finish, finish_choices> list_finishes(SkinPart part, lights::BuildingUse use,
                                                      Age age) {
  const UseGroup group = find_group(use);
  if (part == SkinPart::flat_roof) return flat;
  if (part == SkinPart::pitched_roof) return find_pitched_roof(group, age);
  return walls[static_cast<std::size_t>(group)][static_cast<std::size_t>(age)];
}

BuildingSkin draw_skin(std::uint64_t key, lights::BuildingUse use, Age age) {
  BuildingSkin skin;
  for (std::size_t part = 0; part < skin.of_part.size(); ++part) {
    Random random{static_cast<std::int64_t>(key), static_cast<std::int64_t>(part)};
    const auto finishes_of_part = list_finishes(static_cast<SkinPart>(part), use, age);
    const auto choice = static_cast<std::size_t>(random.integer(0, finish_choices - 1));
    const Finish finish = finishes_of_part[choice];
    const auto shades = static_cast<int>(find_finish(finish).tints.size());
    skin.of_part[part] = {finish, static_cast<std::uint8_t>(random.integer(0, shades - 1))};
  }
  return skin;
}

}  // namespace nightcity::bake
