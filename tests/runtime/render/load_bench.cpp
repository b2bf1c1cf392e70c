// A benchmark: prints how fast a scene is loaded and how much memory the process takes for it,
// above what it had before, beside a plain read of the same files.
//   load_bench SCENE.glb [RUNS] [DEVICE]
// Each run loads the scene once. The figures are of the run in the middle, by time.
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/parallel.h"
#include "runtime/render/device_scene.h"

namespace {

using namespace nightcity;

struct Stopwatch {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double core_start = core_seconds();
  static double core_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
      return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  double wall() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  double cores() const { return core_seconds() - core_start; }
};

// Reads all of a file, with nothing kept.
double read_plainly(const std::filesystem::path& path) {
  std::vector<char> piece(1 << 20);
  std::ifstream in(path, std::ios::binary);
  double bytes = 0;
  while (in.read(piece.data(), std::streamsize(piece.size())), in.gcount() > 0)
    bytes += double(in.gcount());
  return bytes;
}

// Linux: forgets the highest resident set so far, and returns the highest since then.
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}
double find_memory(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.rfind(key, 0) == 0) return 1024 * std::strtod(line.c_str() + key.size(), nullptr);
  return 0;
}
double find_peak() {
  return find_memory("VmHWM:");
}

struct Figures {
  double plain, load, load_cores, upload, upload_cores;  // s
  double load_peak, peak, device;                        // bytes, above what was there before
  std::size_t triangles, lights;
};

Figures run(const std::filesystem::path& glb, gpu::Device& device) {
  Figures f{};
  Stopwatch plain;
  read_plainly(glb);
  read_plainly(std::filesystem::path(glb).replace_extension(".lights"));
  f.plain = plain.wall();
  malloc_trim(0);  // what an earlier run freed does not count
  forget_peak();
  const double before = find_memory("VmRSS:");  // the driver's, for the most part
  Stopwatch loading;
  scene::RenderScene scene = scene::load_render_scene(glb);
  f.load = loading.wall();
  f.load_cores = loading.cores();
  f.load_peak = find_peak() - before;
  f.triangles = scene.triangles.size();
  f.lights = scene.lights.size();
  Stopwatch uploading;
  const render::DeviceScene on_device(device, scene, render::ReleaseGeometry{});
  f.upload = uploading.wall();
  f.upload_cores = uploading.cores();
  f.peak = find_peak() - before;
  f.device = double(on_device.bytes());
  return f;
}

void print(const Figures& f, double bytes, const gpu::Device& device) {
  const double all = f.load + f.upload, cores = f.load_cores + f.upload_cores;
  fmt::print("files            {:.1f} MB, {} triangles, {} lights; {} cores, {}\n", bytes / 1e6,
             f.triangles, f.lights, count_cores(), device.label());
  const auto row = [&](const char* name, double wall, double core) {
    fmt::print("{:<16} {:8.2f} s {:8.2f} core s {:8.0f} MB/s {:8.1f} times a plain read\n", name,
               wall, core, bytes / 1e6 / wall, wall / f.plain);
  };
  row("plain read", f.plain, f.plain);
  row("load", f.load, f.load_cores);
  row("upload, tables", f.upload, f.upload_cores);
  row("both", all, cores);
  fmt::print("memory           {:.2f} times the files while loading, {:.2f} while uploading\n",
             f.load_peak / bytes, f.peak / bytes);
  fmt::print("device           {:.2f} times the files{}\n", f.device / bytes,
             device.info().kind == "cpu" ? ", in the program's own memory: it counts above" : "");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "load_bench SCENE.glb [RUNS] [DEVICE]\n");
    return 2;
  }
  try {
    const std::filesystem::path glb = argv[1];
    const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 1;
    gpu::Device::Options options;
    if (argc > 3) options.select = argv[3];
    gpu::Device device(options);
    std::vector<Figures> figures;
    for (int i = 0; i < runs; ++i) figures.push_back(run(glb, device));
    std::sort(figures.begin(), figures.end(), [](const Figures& a, const Figures& b) {
      return a.load + a.upload < b.load + b.upload;
    });
    const std::filesystem::path lights = std::filesystem::path(glb).replace_extension(".lights");
    double bytes = double(std::filesystem::file_size(glb));
    if (std::filesystem::exists(lights)) bytes += double(std::filesystem::file_size(lights));
    print(figures[figures.size() / 2], bytes, device);
  } catch (const Error& error) {
    fmt::print(stderr, "load_bench: {}\n", error.what());
    return 1;
  }
}
