#include "formats/light_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/cancel.h"
#include "formats/error.h"
#include "formats/georeference_json.h"
#include "formats/json_parse.h"
#include "formats/light_check.h"
#include "formats/light_file_layout.h"
#include "formats/mapped_file.h"
#include "formats/night_check.h"

static_assert(std::endian::native == std::endian::little,
              "city.lights is mapped as it is: this needs a little-endian machine");

namespace nightcity {

using namespace light_file;

void light_file::check_content(const std::string& file, const LightFileContent& content) {
  const auto check = [&](const char* what, std::size_t count, auto&& find_fault) {
    for (std::size_t i = 0; i < count; ++i)
      if (const std::optional<std::string> fault = find_fault(i))
        throw Error(file, what + (" " + std::to_string(i)), *fault);
  };
  if (content.provenance.size() != content.lights.size())
    throw Error(file, "provenance of " + std::to_string(content.provenance.size()) +
                          " lights for " + std::to_string(content.lights.size()));
  const std::size_t profiles = content.profiles.size(), schedules = content.schedules.size();
  check("profile", profiles, [&](std::size_t i) {
    return profile_fault(content.profiles[i], content.profile_data.size());
  });
  check("profile value", content.profile_data.size(),
        [&](std::size_t i) -> std::optional<std::string> {
          const float value = content.profile_data[i];
          if (std::isfinite(value) && value >= 0) return std::nullopt;
          return "is negative or not finite";
        });
  // Profiles may share values: a short file must not choose how long their integrals take.
  std::size_t values = 0;
  for (const LightProfile& profile : content.profiles)
    values += std::size_t{profile.c_count} * profile.gamma_count;
  if (values > max_profile_values)
    throw Error(file, "section PROF", "its profiles have more than 134 million values in all");
  check("profile", profiles, [&](std::size_t i) {
    return profile_integral_fault(content.profiles[i], content.profile_data);
  });
  check("schedule", schedules,
        [&](std::size_t i) { return schedule_fault(content.schedules[i], content.switches); });
  check("light", content.lights.size(), [&](std::size_t i) -> std::optional<std::string> {
    const Light& light = content.lights[i];
    if (light.schedule != LIGHT_ALWAYS_ON && light.schedule >= schedules)
      return "schedule " + std::to_string(light.schedule) + " of " + std::to_string(schedules);
    return light_fault(light, profiles);
  });
  const TrafficContent& traffic = content.traffic;
  if (traffic.trips.empty()) return;
  if (const auto fault = cycle_fault(traffic.cycle)) throw Error(file, "traffic", *fault);
  check("vehicle", traffic.vehicles.size(), [&](std::size_t i) {
    return vehicle_fault(traffic.vehicles[i], traffic.vehicle_lights.size());
  });
  check("vehicle light", traffic.vehicle_lights.size(),
        [&](std::size_t i) { return vehicle_light_fault(traffic.vehicle_lights[i], profiles); });
  check("trip", traffic.trips.size(), [&](std::size_t i) {
    return trip_fault(traffic.trips[i], traffic.cycle, traffic.vehicles.size(), traffic.knots);
  });
}

struct LightFile::Mapping {
  std::string name;
  MappedFile file;
  std::vector<Section> table;
  Georeference georeference;
  std::span<const Light> lights;
  std::span<const LightProvenance> provenance;
  std::span<const LightProfile> profiles;
  std::span<const float> profile_data;
  std::span<const Schedule> schedules;
  std::span<const uint> switches;
  TrafficContent traffic;

  explicit Mapping(const std::filesystem::path& path) : name(path.string()), file(path) {
    read_table();
    std::span<const char> text;
    take(tag_georeference, text);
    take(tag_lights, lights);
    take(tag_provenance, provenance);
    take(tag_profiles, profiles);
    take(tag_profile_data, profile_data);
    if (has(tag_schedules)) {
      take(tag_schedules, schedules);
      take(tag_switches, switches);
    }
    if (has(tag_trips)) take_traffic();
    check_small_sections(text);
  }

  void read_table();
  bool has(std::array<char, 4> tag) const;
  void take_traffic();
  template <class T>
  void take(std::array<char, 4> tag, std::span<const T>& data);
  void check_small_sections(std::span<const char> text);
};

void LightFile::Mapping::read_table() {
  const auto bytes = file.bytes();
  Header header;
  if (bytes.empty()) throw Error(name, "is empty");
  if (bytes.size() < magic.size() || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    throw Error(name, "is not a light file");
  if (bytes.size() < sizeof header)
    throw Error(name, "byte " + std::to_string(bytes.size()), "ends in the header");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.header_checksum != checksum(&header, offsetof(Header, header_checksum)))
    throw Error(name, "header", "checksum does not match");
  if (header.major_version != major_version)
    throw Error(name, "header",
                "version " + std::to_string(header.major_version) + "." +
                    std::to_string(header.minor_version) + ", this program reads version " +
                    std::to_string(major_version));
  if (header.file_size != bytes.size())
    throw Error(name, "byte " + std::to_string(bytes.size()),
                "file of " + std::to_string(header.file_size) + " bytes ends here");
  if (header.section_count > max_sections || header.table_offset % alignof(Section) != 0 ||
      header.table_offset > bytes.size() ||
      header.section_count > (bytes.size() - header.table_offset) / sizeof(Section))
    throw Error(name, "header", "section table lies outside the file");
  table.resize(header.section_count);
  if (!table.empty())  // memcpy may not be given a null pointer, even for 0 bytes
    std::memcpy(table.data(), bytes.data() + header.table_offset, table.size() * sizeof(Section));
  if (header.table_checksum != checksum(table.data(), table.size() * sizeof(Section)))
    throw Error(name, "section table", "checksum does not match");
  for (const Section& section : table)
    if (section.element_size == 0 || section.offset % section_alignment != 0 ||
        section.offset > bytes.size() ||
        section.element_count > (bytes.size() - section.offset) / section.element_size)
      throw Error(name, name_of(section), "lies outside the file");
}

template <class T>
void LightFile::Mapping::take(std::array<char, 4> tag, std::span<const T>& data) {
  const auto has_tag = [&](const Section& section) { return section.tag == tag; };
  const auto found = std::find_if(table.begin(), table.end(), has_tag);
  if (found == table.end()) throw Error(name, name_of({tag, 0, 0, 0, 0}), "is missing");
  if (std::find_if(found + 1, table.end(), has_tag) != table.end())
    throw Error(name, name_of(*found), "occurs twice");
  if (found->element_size != sizeof(T))
    throw Error(name, name_of(*found),
                "has elements of " + std::to_string(found->element_size) + " bytes, not " +
                    std::to_string(sizeof(T)));
  // The cast is aligned for every T: sections are aligned to 64 bytes, the mapping to a page.
  data = {reinterpret_cast<const T*>(file.bytes().data() + found->offset),
          static_cast<std::size_t>(found->element_count)};
}

bool LightFile::Mapping::has(std::array<char, 4> tag) const {
  return std::any_of(table.begin(), table.end(),
                     [&](const Section& section) { return section.tag == tag; });
}

void LightFile::Mapping::take_traffic() {
  std::span<const TrafficCycle> cycle;
  take(tag_cycle, cycle);
  if (cycle.size() != 1)
    throw Error(name, "section CYCL", "holds " + std::to_string(cycle.size()) + " elements");
  traffic.cycle = cycle.front();
  take(tag_vehicles, traffic.vehicles);
  take(tag_vehicle_lights, traffic.vehicle_lights);
  take(tag_trips, traffic.trips);
  take(tag_knots, traffic.knots);
}

void LightFile::Mapping::check_small_sections(std::span<const char> text) {
  if (provenance.size() != lights.size())
    throw Error(name, "section PROV",
                "holds " + std::to_string(provenance.size()) + " entries for " +
                    std::to_string(lights.size()) + " lights");
  if (lights.size() >= LIGHT_ALWAYS_ON) throw Error(name, "section LGHT", "holds too many lights");
  if (profiles.size() > max_profiles) throw Error(name, "section PROF", "holds too many profiles");
  for (std::size_t i = 0; i < profiles.size(); ++i)
    if (const auto fault = profile_fault(profiles[i], profile_data.size()))
      throw Error(name, "profile " + std::to_string(i), *fault);
  if (text.size() > max_georeference_bytes) throw Error(name, "section GEOR", "is too long");
  try {
    georeference =
        georeference_from_json(parse_json(std::string_view(text.data(), text.size()), ""));
  } catch (const nlohmann::json::exception& error) {
    throw Error(name, "section GEOR", describe(error));
  } catch (const Error& error) {
    throw Error(name, "section GEOR", error.what());
  }
}

LightFile LightFile::open(const std::filesystem::path& path) {
  return LightFile(std::make_unique<Mapping>(path));
}

void LightFile::verify() const {
  for (const Section& section : mapping_->table) {
    throw_if_cancelled();
    const auto size = static_cast<std::size_t>(section.element_count * section.element_size);
    if (section.checksum != checksum(mapping_->file.bytes().data() + section.offset, size))
      throw Error(mapping_->name, name_of(section), "checksum does not match");
  }
  check_content(mapping_->name, {georeference(), lights(), provenance(), profiles(), profile_data(),
                                 schedules(), switches(), traffic()});
}

const Georeference& LightFile::georeference() const {
  return mapping_->georeference;
}
std::span<const Light> LightFile::lights() const {
  return mapping_->lights;
}
std::span<const LightProvenance> LightFile::provenance() const {
  return mapping_->provenance;
}
std::span<const LightProfile> LightFile::profiles() const {
  return mapping_->profiles;
}
std::span<const float> LightFile::profile_data() const {
  return mapping_->profile_data;
}
std::span<const Schedule> LightFile::schedules() const {
  return mapping_->schedules;
}
std::span<const uint> LightFile::switches() const {
  return mapping_->switches;
}
TrafficContent LightFile::traffic() const {
  return mapping_->traffic;
}

LightFile::LightFile(std::unique_ptr<Mapping> mapping) : mapping_(std::move(mapping)) {}
LightFile::LightFile(LightFile&&) noexcept = default;
LightFile& LightFile::operator=(LightFile&&) noexcept = default;
LightFile::~LightFile() = default;

}  // namespace nightcity
