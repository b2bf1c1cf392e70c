#include "formats/light_file_edit.h"

#include <utility>
#include <vector>

namespace nightcity {

LightFileContent to_content(const LightFile& file) {
  LightFileContent content;
  content.georeference = file.georeference();
  content.lights = file.lights();
  content.provenance = file.provenance();
  content.profiles = file.profiles();
  content.profile_data = file.profile_data();
  content.schedules = file.schedules();
  content.switches = file.switches();
  content.traffic = file.traffic();
  return content;
}

void finish_with_traffic(LightFileWriter& writer, LightFileContent rest,
                         const TrafficAddition& addition) {
  std::vector<LightProfile> profiles(rest.profiles.begin(), rest.profiles.end());
  std::vector<float> data(rest.profile_data.begin(), rest.profile_data.end());
  const auto first_profile = static_cast<uint>(profiles.size()),
             first_value = static_cast<uint>(data.size());
  for (LightProfile profile : addition.profiles) {
    profile.data_offset += first_value;
    profiles.push_back(profile);
  }
  data.insert(data.end(), addition.profile_data.begin(), addition.profile_data.end());
  std::vector<Light> lights(addition.traffic.vehicle_lights.begin(),
                            addition.traffic.vehicle_lights.end());
  for (Light& light : lights)
    light.kind_profile = pack_kind_profile(light_kind(light), light_profile(light) + first_profile);
  rest.profiles = profiles;
  rest.profile_data = data;
  rest.traffic = {};
  if (!addition.traffic.trips.empty()) {
    rest.traffic = addition.traffic;
    rest.traffic.vehicle_lights = lights;
  }
  writer.finish(rest);
}

void write_with_traffic(const std::filesystem::path& path, LightFileContent content,
                        const TrafficAddition& addition) {
  LightFileWriter writer(path);
  finish_with_traffic(writer, std::move(content), addition);
}

}  // namespace nightcity
