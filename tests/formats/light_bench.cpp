// A benchmark: prints how fast city.lights is written, opened and checked.
//   light_bench [LIGHTS] [FOLDER]
// Default: 1000000 lights, in the system's folder for temporary files.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "formats/error.h"
#include "formats/light_file_writer.h"
#include "formats/rgb9e5.h"

namespace {

using namespace nightcity;

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Light window(std::uint32_t n) {
  Light light{};
  light.position = {static_cast<float>(n % 1000) * 4, 10, static_cast<float>(n / 1000) * 4};
  light.axis = {0, 0, 1};
  light.tangent = {1, 0, 0};
  set_half_width(light, 0.6f);
  light.half_height = 0.7f;
  light.flux_lm = 100;
  light.colour_rgb9e5 = encode_rgb9e5({1.2f, 1, 0.6f});
  light.kind_profile = pack_kind_profile(LightKind::rectangle, LIGHT_NO_PROFILE);
  light.schedule = n % 1000;
  light.id = n;
  return light;
}

void run(std::uint32_t count, const std::filesystem::path& file) {
  std::vector<Schedule> schedules;
  std::vector<uint> switches;
  for (uint n = 0; n < 1000; ++n) {
    schedules.push_back({2 * n, 2});
    switches.insert(switches.end(), {18'000 + n, 40'000 + n});
  }
  const double write = seconds_of([&] {
    LightFileWriter writer(file);
    for (std::uint32_t n = 0; n < count; ++n) writer.add(window(n), {});
    LightFileContent rest;
    rest.schedules = schedules;
    rest.switches = switches;
    writer.finish(rest);
  });
  std::vector<double> opened;
  for (int n = 0; n < 101; ++n) opened.push_back(seconds_of([&] { LightFile::open(file); }));
  std::sort(opened.begin(), opened.end());
  const double verify = seconds_of([&] { LightFile::open(file).verify(); });
  double sum = 0;
  const double scan = seconds_of([&] {
    const LightFile lights = LightFile::open(file);
    for (const Light& light : lights.lights()) sum += double{light.flux_lm};
  });
  const double million = count / 1e6;
  std::printf("lights        %u (%.1f MB, %.0f klm)\n", count,
              static_cast<double>(std::filesystem::file_size(file)) / 1e6, sum / 1000);
  std::printf("write         %.3f s, %.1f M lights/s\n", write, million / write);
  std::printf("open          %.3f ms median of 101, %.3f ms worst\n", 1000 * opened[50],
              1000 * opened.back());
  std::printf("open, verify  %.3f s, %.1f M lights/s\n", verify, million / verify);
  std::printf("open, scan    %.3f s, %.1f M lights/s\n", scan, million / scan);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint32_t count =
      argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 1'000'000;
  const std::filesystem::path folder =
      argc > 2 ? argv[2] : std::filesystem::temp_directory_path().string();
  try {
    run(count, folder / "light_bench.lights");
    std::filesystem::remove(folder / "light_bench.lights");
  } catch (const nightcity::Error& error) {
    std::fprintf(stderr, "light_bench: %s\n", error.what());
    return 1;
  }
}
