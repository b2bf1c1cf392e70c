#include "formats/light_file_writer.h"

#include <xxhash.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/georeference_json.h"
#include "formats/json_text.h"
#include "formats/light_check.h"
#include "formats/light_file_layout.h"
#include "formats/night_check.h"
#include "formats/scene_identity.h"
#include "formats/scratch_file.h"

namespace nightcity {

using namespace light_file;

namespace {

// The XXH64 checksum of bytes that are added piece by piece.
class RunningChecksum {
 public:
  RunningChecksum() { XXH64_reset(state_.get(), 0); }
  void add(const void* bytes, std::size_t size) { XXH64_update(state_.get(), bytes, size); }
  std::uint64_t value() const { return XXH64_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
  };
  std::unique_ptr<XXH64_state_t, Free> state_{XXH64_createState()};
};

void align(AtomicFile& file) {
  constexpr std::array<char, section_alignment> zeros{};
  file.write(zeros.data(),
             (section_alignment - file.size() % section_alignment) % section_alignment);
}

// A section whose records are added before its place in the file is known.
class StreamedSection {
 public:
  explicit StreamedSection(const std::filesystem::path& path) : file_(path) {}

  template <class T>
  void add(std::span<const T> records) {
    file_.write(records.data(), records.size_bytes());
    sum_.add(records.data(), records.size_bytes());
    count_ += records.size();
  }
  std::uint64_t count() const { return count_; }
  void write(AtomicFile& file, std::vector<Section>& table, std::array<char, 4> tag,
             std::uint32_t record_size) {
    align(file);
    table.push_back({tag, record_size, file.size(), count_, sum_.value()});
    file_.copy_to(file);
  }

 private:
  ScratchFile file_;
  RunningChecksum sum_;
  std::uint64_t count_ = 0;
};

template <class T>
void write_section(AtomicFile& file, std::vector<Section>& table, std::array<char, 4> tag,
                   std::span<const T> data) {
  align(file);
  table.push_back(
      {tag, sizeof(T), file.size(), data.size(), checksum(data.data(), data.size_bytes())});
  file.write(data.data(), data.size_bytes());
}

}  // namespace

struct LightFileWriter::State {
  std::string name;
  AtomicFile file;  // room for the header, then the lights
  RunningChecksum lights_sum;
  StreamedSection provenances, schedules, switches;  // to be written after the lights
  std::uint64_t count = 0;
  // The largest profile and schedule index that a light refers to, plus one.
  std::size_t profiles_named = 0, schedules_named = 0;

  explicit State(const std::filesystem::path& path)
      : name(path.string()), file(path), provenances(path), schedules(path), switches(path) {
    constexpr Header room{};
    file.write(&room, sizeof room);
  }

  std::uint32_t add_schedule(uint first, uint count) {
    if (schedules.count() + 1 >= LIGHT_ALWAYS_ON)
      throw Error(name, "more schedules than the format can number");
    const Schedule schedule{first, count};
    schedules.add(std::span(&schedule, 1));
    return static_cast<std::uint32_t>(schedules.count() - 1);
  }

  // Returns the index of the first of these switch times.
  uint add_switches(std::span<const uint> times) {
    const std::uint64_t first = switches.count();
    if (first + times.size() > std::numeric_limits<uint>::max())
      throw Error(name, "more switch times than the format can number");
    switches.add(times);
    return static_cast<uint>(first);
  }
};

LightFileWriter::LightFileWriter(const std::filesystem::path& path)
    : state_(std::make_unique<State>(path)) {}
LightFileWriter::~LightFileWriter() = default;

std::uint32_t LightFileWriter::add(const Light& light, const LightProvenance& provenance) {
  State& state = *state_;
  // finish() checks the indices of profiles and schedules, when their numbers are known.
  constexpr std::size_t any_profile = std::size_t{LIGHT_NO_PROFILE} + 1;
  if (const auto fault = light_fault(light, any_profile))
    throw Error(state.name, "light " + std::to_string(state.count), *fault);
  if (state.count + 1 >= LIGHT_ALWAYS_ON)
    throw Error(state.name, "more lights than the format can number");
  const std::size_t profile = light_profile(light);
  if (profile != LIGHT_NO_PROFILE)
    state.profiles_named = std::max(state.profiles_named, profile + 1);
  if (light.schedule != LIGHT_ALWAYS_ON)
    state.schedules_named = std::max(state.schedules_named, std::size_t{light.schedule} + 1);
  state.file.write(&light, sizeof light);
  state.lights_sum.add(&light, sizeof light);
  state.provenances.add(std::span(&provenance, 1));
  return static_cast<std::uint32_t>(state.count++);
}

std::uint32_t LightFileWriter::add_schedule(std::span<const uint> switches) {
  State& state = *state_;
  const auto count = static_cast<uint>(switches.size());
  if (const auto fault = schedule_fault({0, count}, switches))
    throw Error(state.name, "schedule " + std::to_string(state.schedules.count()), *fault);
  return state.add_schedule(state.add_switches(switches), count);
}

std::string LightFileWriter::scene_id(const Georeference& georeference) const {
  return make_scene_id(georeference, state_->lights_sum.value());
}

void LightFileWriter::finish(const LightFileContent& rest) {
  State& state = *state_;
  check_content(state.name, rest);
  for (std::size_t i = 0; i < rest.lights.size(); ++i) add(rest.lights[i], rest.provenance[i]);
  const uint first_switch = state.add_switches(rest.switches);
  for (const Schedule& schedule : rest.schedules)
    state.add_schedule(first_switch + schedule.first, schedule.count);
  if (state.profiles_named > rest.profiles.size() ||
      state.schedules_named > state.schedules.count())
    throw Error(state.name, "a light refers to a profile or schedule that does not exist");
  // open() enforces the same limits: every file that is written can be read.
  if (rest.profiles.size() > max_profiles) throw Error(state.name, "more than 65536 profiles");
  const std::string georeference = dump(georeference_to_json(rest.georeference));
  if (georeference.size() > max_georeference_bytes)
    throw Error(state.name, "the list of sources is too long");

  AtomicFile& file = state.file;
  std::vector<Section> table;
  table.push_back(
      {tag_lights, sizeof(Light), sizeof(Header), state.count, state.lights_sum.value()});
  state.provenances.write(file, table, tag_provenance, sizeof(LightProvenance));
  write_section(file, table, tag_georeference, std::span<const char>(georeference));
  write_section(file, table, tag_profiles, rest.profiles);
  write_section(file, table, tag_profile_data, rest.profile_data);
  if (state.schedules.count() != 0) {
    state.schedules.write(file, table, tag_schedules, sizeof(Schedule));
    state.switches.write(file, table, tag_switches, sizeof(uint));
  }
  if (const TrafficContent& traffic = rest.traffic; !traffic.trips.empty()) {
    write_section(file, table, tag_cycle, std::span(&traffic.cycle, 1));
    write_section(file, table, tag_vehicles, traffic.vehicles);
    write_section(file, table, tag_vehicle_lights, traffic.vehicle_lights);
    write_section(file, table, tag_trips, traffic.trips);
    write_section(file, table, tag_knots, traffic.knots);
  }
  align(file);

  Header header{};
  header.magic = magic;
  header.major_version = major_version;
  header.minor_version = minor_version;
  header.section_count = static_cast<std::uint32_t>(table.size());
  header.table_offset = file.size();
  header.table_checksum = checksum(table.data(), table.size() * sizeof(Section));
  file.write(table.data(), table.size() * sizeof(Section));
  header.file_size = file.size();
  header.header_checksum = checksum(&header, offsetof(Header, header_checksum));
  file.write_at(0, &header, sizeof header);
  file.commit();
}

void write_light_file(const std::filesystem::path& path, const LightFileContent& content) {
  check_content(path.string(), content);  // before the file is created
  LightFileWriter(path).finish(content);
}

}  // namespace nightcity
