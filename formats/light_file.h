// city.lights: every light of a scene, read by mapping. Layout in SPEC.md.
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

/// Where each value of a light came from; one byte a value, parallel to the lights.
enum class ValueSource : std::uint8_t {
  unknown = 0,
  tag = 1,
  attribute = 2,
  rule = 3,
  standard = 4
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
    case ValueSource::unknown:
      break;
  }
  return "unknown";
}

/// Provenance of one light, 16 bytes, parallel to the lights (section PROV).
struct LightProvenance {
  std::uint64_t source_id = 0;  // OSM node id, or a hash of the CityGML id; 0 = none
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

/// What a light is to a person; counted by `inspect`, and a layer of the renderer's output.
enum class LightFamily : std::uint8_t {
  lamp = 0,
  window = 1,
  headlamp = 2,
  tail_lamp = 3,
  other = 4
};
constexpr std::size_t light_family_count = 5;

/// Returns the family's name in reports ("lamp", "tail_lamp", ...); a value out of range is "other".
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

/// Vehicles on their ways; empty `trips`: no traffic.
struct TrafficContent {
  TrafficCycle cycle{};
  std::span<const VehicleKind> vehicles;
  std::span<const Light> vehicle_lights;  // in vehicle frames; see night.h
  std::span<const Trip> trips;
  std::span<const TripKnot> knots;
};

/// What a writer needs. Spans must live until write_light_file returns.
struct LightFileContent {
  Georeference georeference{};
  std::span<const Light> lights{};
  std::span<const LightProvenance> provenance{};  // same length as lights
  std::span<const LightProfile> profiles{};
  std::span<const float> profile_data{};
  std::span<const Schedule> schedules{};
  std::span<const uint> switches{};  // s since noon; the schedules point into them
  TrafficContent traffic{};
};

/// Writes beside `path` and renames; for lights that are not all in memory see light_file_writer.h. Throws
/// Error when a record is unfit (light_check.h, night_check.h), or when the file cannot be written.
void write_light_file(const std::filesystem::path& path, const LightFileContent& content);

/// A mapped city.lights. Spans point into the mapping and live as long as this object.
class LightFile {
 public:
  /// Checks magic, version, section table and its checksum, and that every section lies inside the file:
  /// constant time whatever the size. Throws Error.
  static LightFile open(const std::filesystem::path& path);

  /// Recomputes every section's checksum and checks every record as write_light_file does: linear time.
  /// Throws Error.
  void verify() const;

  const Georeference& georeference() const;
  std::span<const Light> lights() const;
  std::span<const LightProvenance> provenance() const;
  std::span<const LightProfile> profiles() const;
  std::span<const float> profile_data() const;
  std::span<const Schedule> schedules() const;
  std::span<const uint> switches() const;
  TrafficContent traffic() const;  // spans into the mapping

  LightFile(LightFile&&) noexcept;
  LightFile& operator=(LightFile&&) noexcept;
  ~LightFile();

 private:
  struct Mapping;
  explicit LightFile(std::unique_ptr<Mapping> mapping);
  std::unique_ptr<Mapping> mapping_;
};

}  // namespace nightcity
