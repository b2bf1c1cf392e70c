// The layout of city.lights on the disk (SPEC.md, section 3), shared by its reader and its writer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "formats/checksum.h"
#include "formats/light_file.h"

namespace nightcity::light_file {

inline constexpr std::array<char, 8> magic{'N', 'C', 'L', 'I', 'G', 'H', 'T', 'S'};
constexpr std::uint16_t major_version = 1, minor_version = 0;
constexpr std::uint64_t section_alignment = 64;
constexpr std::uint32_t max_sections = 1024;  // bounds the work of open() on a hostile file
constexpr std::uint64_t max_georeference_bytes = 1 << 20;
constexpr std::uint64_t max_profiles = 65536;
constexpr std::uint64_t max_profile_values = std::uint64_t{1} << 27;

struct Header {
  std::array<char, 8> magic;
  std::uint16_t major_version, minor_version;
  std::uint32_t section_count;
  std::uint64_t file_size;
  std::uint64_t table_offset;
  std::uint64_t table_checksum;  // XXH64 of the section table
  std::uint64_t reserved[2];
  std::uint64_t header_checksum;  // XXH64 of the bytes before it
};
static_assert(sizeof(Header) == 64);

struct Section {
  std::array<char, 4> tag;
  std::uint32_t element_size;
  std::uint64_t offset, element_count;
  std::uint64_t checksum;  // XXH64 of the section's bytes
};
static_assert(sizeof(Section) == 32);

inline constexpr std::array<char, 4> tag_georeference{'G', 'E', 'O', 'R'},
    tag_lights{'L', 'G', 'H', 'T'}, tag_provenance{'P', 'R', 'O', 'V'},
    tag_profiles{'P', 'R', 'O', 'F'}, tag_profile_data{'P', 'D', 'A', 'T'};
// These are present only if the scene has such records.
inline constexpr std::array<char, 4> tag_schedules{'S', 'C', 'H', 'D'},
    tag_switches{'S', 'W', 'C', 'H'}, tag_cycle{'C', 'Y', 'C', 'L'},
    tag_vehicles{'V', 'E', 'H', 'I'}, tag_vehicle_lights{'V', 'L', 'G', 'T'},
    tag_trips{'T', 'R', 'I', 'P'}, tag_knots{'K', 'N', 'O', 'T'};

inline std::string name_of(const Section& section) {
  std::string name = "section ";
  for (const char c : section.tag) name += (c >= ' ' && c <= '~') ? c : '?';
  return name;
}

/// Checks each record of a light file, in linear time. Throws Error, with `file` as the file's
/// name.
void check_content(const std::string& file, const LightFileContent& content);

}  // namespace nightcity::light_file
