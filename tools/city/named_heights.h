// Heights and storeys of buildings under names that producers chose: no standard has them.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace nightcity::city {

/// Collects what generic attributes of a building say of its height: its storeys ("levels",
/// "AnzahlGeschosse"), the height itself ("height",
/// "Gebäudehöhe"), or the elevations of its roof and ground (3DBAG's b3_h_dak_70p and
/// b3_h_maaiveld, the German surveys' HoeheDach and HoeheGrund, swisstopo's DACH_MAX and
/// GELAENDEPUNKT).
class NamedHeights {
 public:
  /// Returns whether an attribute has one of these names. `name`: in lower case.
  static bool knows(std::string_view name);
  /// Takes the value of an attribute of such a name. `unit`: "" where it has none.
  void take(std::string_view name, std::string_view value, std::string_view unit);

  /// Returns the height; nothing where the attributes give none. `elevation_unit_m`: that of the
  /// CRS's heights, in which elevations are.
  std::optional<double> find_height_m(double elevation_unit_m) const;
  /// Returns the storeys above the ground; nothing where the attributes give none.
  const std::optional<int>& storeys() const { return storeys_; }

 private:
  std::optional<double> height_m_;
  std::array<std::optional<double>, 3> roofs_;  // the fittest first
  std::optional<double> ground_;
  std::optional<int> storeys_;
};

}  // namespace nightcity::city
