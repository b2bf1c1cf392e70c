// Writes a city.lights whose lights and schedules come one by one and need not all be in memory.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "formats/light_file.h"

namespace nightcity {

class LightFileWriter {
 public:
  /// Writes beside `path`; until finish() nothing stands under that name. Throws Error where it cannot.
  explicit LightFileWriter(const std::filesystem::path& path);
  ~LightFileWriter();
  LightFileWriter(const LightFileWriter&) = delete;
  LightFileWriter& operator=(const LightFileWriter&) = delete;

  /// The light's number in the file. Throws Error when it is unfit (light_check.h).
  std::uint32_t add(const Light& light, const LightProvenance& provenance);

  /// The number of a schedule with these switch times (s since noon). Throws Error when it is unfit
  /// (night_check.h).
  std::uint32_t add_schedule(std::span<const uint> switches);

  /// Everything else, after `rest.lights` and `rest.provenance` (empty where all have been added);
  /// `rest.schedules` follow those that have been added. Throws Error when a record is unfit or a light names
  /// a profile or schedule that is not there.
  void finish(const LightFileContent& rest);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
