// city.lights: every light of a scene, mapped into memory. SPEC.md describes its layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/georeference.h"
#include "formats/light.h"
#include "formats/night.h"

namespace nightcity {

/// The origin of one value of a light.
enum class ValueSource : std::uint8_t {
  unknown = 0,
  tag = 1,        // a tag of the map
  attribute = 2,  // an attribute of the city model
  rule = 3,       // a rule of ours, stated beside the rule
  standard = 4,   // a published standard
  inventory = 5,  // a town's inventory of its lamps
  edit = 6        // a hand that changed it (light_edits.h)
};

/// Returns the source's name in reports ("tag", "rule", ...); a value out of range is "unknown".
constexpr const char* name_of(ValueSource source) {
  switch (source) {
    case ValueSource::tag:
      return "tag";
    case ValueSource::attribute:
      return "attribute";
    case ValueSource::rule:
      return "rule";
    case ValueSource::standard:
      return "standard";
    case ValueSource::inventory:
      return "inventory";
    case ValueSource::edit:
      return "edit";
    case ValueSource::unknown:
      break;
  }
  return "unknown";
}

/// The origin of each value of one light. Section PROV holds one record of 16 bytes for each light,
/// in the same order.
struct LightProvenance {
  /// OSM node id, or a hash of the CityGML id or of an inventory's row; 0 = none
  std::uint64_t source_id = 0;
  ValueSource position = ValueSource::unknown;
  ValueSource height = ValueSource::unknown;
  ValueSource flux = ValueSource::unknown;
  ValueSource colour = ValueSource::unknown;
  ValueSource profile = ValueSource::unknown;
  ValueSource schedule = ValueSource::unknown;
  std::uint8_t family = 0;  // LightFamily
  std::uint8_t reserved = 0;
};
static_assert(sizeof(LightProvenance) == 16);

/// The use of a light. `nightbake inspect` counts lights by it, and it is a layer of the renderer's
/// output.
enum class LightFamily : std::uint8_t {
  lamp = 0,
  window = 1,
  headlamp = 2,
  tail_lamp = 3,
  other = 4
};
constexpr std::size_t light_family_count = 5;

/// Returns the family's name in reports ("lamp", "tail_lamp", ...); a value
/// out of range is "other".
constexpr const char* name_of(LightFamily family) {
  switch (family) {
    case LightFamily::lamp:
      return "lamp";
    case LightFamily::window:
      return "window";
    case LightFamily::headlamp:
      return "headlamp";
    case LightFamily::tail_lamp:
      return "tail_lamp";
    case LightFamily::other:
      break;
  }
  return "other";
}

/// Vehicles and their trips. Without traffic, `trips` is empty.
struct TrafficContent {
  TrafficCycle cycle{};
  std::span<const VehicleKind> vehicles;
  std::span<const Light> vehicle_lights;  // in the frame of their vehicle (night.h)
  std::span<const Trip> trips;
  std::span<const TripKnot> knots;
};

/// The content of a light file. The spans refer to memory of the caller.
struct LightFileContent {
  Georeference georeference{};
  std::span<const Light> lights{};
  std::span<const LightProvenance> provenance{};  // same length as lights
  std::span<const LightProfile> profiles{};
  std::span<const float> profile_data{};
  std::span<const Schedule> schedules{};
  std::span<const uint> switches{};  // s since noon; schedules are ranges of these
  TrafficContent traffic{};
};

/// Writes a light file; it gets its name when it is complete. For lights that do not fit into
/// memory see light_file_writer.h. Throws Error if a record is invalid (light_check.h,
/// night_check.h) or the file cannot be written.
void write_light_file(const std::filesystem::path& path, const LightFileContent& content);

/// A light file mapped into memory. The spans point into the mapping and are valid as long as this
/// object.
class LightFile {
 public:
  /// Checks magic number, version, section table and its checksum, and that each section lies
  /// inside the file: the time does not grow with the number of lights. Throws Error.
  static LightFile open(const std::filesystem::path& path);

  /// Checks all that SPEC.md tells a reader to refuse: the checksum of each section, and each
  /// record as write_light_file does. The time grows with the size. Throws Error, or Cancelled
  /// (cancel.h).
  void verify() const;

  const Georeference& georeference() const;
  std::span<const Light> lights() const;
  std::span<const LightProvenance> provenance() const;
  std::span<const LightProfile> profiles() const;
  std::span<const float> profile_data() const;
  std::span<const Schedule> schedules() const;
  std::span<const uint> switches() const;
  TrafficContent traffic() const;

  LightFile(LightFile&&) noexcept;
  LightFile& operator=(LightFile&&) noexcept;
  ~LightFile();

 private:
  struct Mapping;
  explicit LightFile(std::unique_ptr<Mapping> mapping);
  std::unique_ptr<Mapping> mapping_;
};

}  // namespace nightcity
