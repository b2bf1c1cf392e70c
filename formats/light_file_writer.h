// Writes a city.lights whose lights and schedules are added one by one and need not fit into
// memory.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "formats/light_file.h"

namespace nightcity {

class LightFileWriter {
 public:
  /// Writes to a scratch file beside `path`, which gets its name from finish(). Throws Error if
  /// that fails.
  explicit LightFileWriter(const std::filesystem::path& path);
  ~LightFileWriter();
  LightFileWriter(const LightFileWriter&) = delete;
  LightFileWriter& operator=(const LightFileWriter&) = delete;

  /// Adds a light and returns its index in the file. Throws Error if it is invalid (light_check.h).
  std::uint32_t add(const Light& light, const LightProvenance& provenance);

  /// Adds a schedule with these switch times (s since noon) and returns its index. Throws Error if
  /// it is invalid (night_check.h).
  std::uint32_t add_schedule(std::span<const uint> switches);

  /// Returns the identity of the scene of these lights and this georeference, for both files of the
  /// scene (scene_identity.h). To be called when all lights have been added.
  std::string scene_id(const Georeference& georeference) const;

  /// Adds `rest` and completes the file. Lights and schedules of `rest` follow those that were
  /// added one by one. Throws Error if a record is invalid or a light refers to a profile or
  /// schedule that does not exist.
  void finish(const LightFileContent& rest);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
