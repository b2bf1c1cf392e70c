// Measures the readers of CityGML, CityJSON and CityJSONSeq on the same city, on one thread.
//   cityjson_bench CITY.gml [--copies N]
//   cityjson_bench CITY.json
// The city is read, and written N times over as CityJSON and as CityJSONSeq, each polygon with its
// semantic surface. What is printed for each reader: CPU seconds, megabytes and polygons a second,
// and by how much the peak of the process's memory grew (the first reading sets it for later ones
// of less memory, so the one that needs least comes first).
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "formats/error.h"
#include "tools/inputs/read_city.h"

namespace nightcity::cityjson {
namespace {

namespace fs = std::filesystem;

const char* find_semantic_type(city::SurfaceType surface) {
  switch (surface) {
    case city::SurfaceType::roof:
      return "RoofSurface";
    case city::SurfaceType::ground:
      return "GroundSurface";
    default:
      return "WallSurface";
  }
}

// Writes objects with vertices in millimetres from the first one.
class CityJsonWriter {
 public:
  explicit CityJsonWriter(const glm::dvec3& origin) : origin_(origin) {}

  std::string write(const city::CityObject& object, const std::string& id) {
    std::string boundaries, values;
    for (const city::Polygon& polygon : object.polygons) {
      const bool first = boundaries.empty();
      boundaries += first ? "[" : ",[";
      append(polygon.exterior, boundaries);
      for (const city::Ring& ring : polygon.interiors) append(ring, boundaries += ',');
      boundaries += "]";
      const std::string type = find_semantic_type(polygon.surface);
      values += std::string(first ? "" : ",") + (type == "RoofSurface"     ? "0"
                                                 : type == "GroundSurface" ? "1"
                                                                           : "2");
    }
    return "\"" + id + "\":{\"type\":\"Building\",\"attributes\":{\"measuredHeight\":" +
           std::to_string(object.measured_height_m.value_or(9)) +
           "},\"geometry\":[{\"type\":\"MultiSurface\",\"lod\":\"2\",\"boundaries\":[" +
           boundaries +
           "],\"semantics\":{\"surfaces\":[{\"type\":\"RoofSurface\"},{\"type\":\"GroundSurface\"},"
           "{\"type\":\"WallSurface\"}],\"values\":[" +
           values + "]}}]}";
  }

  const std::string& vertices() const { return vertices_; }
  void clear() {
    vertices_.clear();
    numbers_.clear();
  }

 private:
  void append(const city::Ring& ring, std::string& out) {
    out += "[";
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec3 p = glm::round((ring[i] - origin_) * 1000.0);
      const auto [at, is_new] = numbers_.try_emplace({p.x, p.y, p.z}, numbers_.size());
      if (is_new)
        vertices_ += std::string(vertices_.empty() ? "[" : ",[") +
                     std::to_string(std::lround(p.x)) + "," + std::to_string(std::lround(p.y)) +
                     "," + std::to_string(std::lround(p.z)) + "]";
      out += (i ? "," : "") + std::to_string(at->second);
    }
    out += "]";
  }

  glm::dvec3 origin_;
  std::string vertices_;
  std::map<std::tuple<double, double, double>, std::size_t> numbers_;
};

std::string make_header(const glm::dvec3& origin) {
  return "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"transform\":{\"scale\":[0.001,0.001,0.001],"
         "\"translate\":[" +
         std::to_string(origin.x) + "," + std::to_string(origin.y) + "," +
         std::to_string(origin.z) + "]},\"CityObjects\":{";
}

void write_both(const std::vector<city::CityObject>& objects, int copies, const fs::path& whole,
                const fs::path& lines) {
  const glm::dvec3 origin = objects.front().polygons.front().exterior.front();
  std::ofstream one(whole, std::ios::binary), many(lines, std::ios::binary);
  CityJsonWriter shared(origin), own(origin);
  one << make_header(origin);
  many << make_header(origin) << "},\"vertices\":[]}\n";
  for (int copy = 0; copy < copies; ++copy)
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const std::string id = std::to_string(copy) + "-" + std::to_string(i);
      one << (copy + i > 0 ? "," : "") << shared.write(objects[i], id);
      own.clear();
      const std::string text = own.write(objects[i], id);
      many << "{\"type\":\"CityJSONFeature\",\"id\":\"" << id << "\",\"CityObjects\":{" << text
           << "},\"vertices\":[" << own.vertices() << "]}\n";
    }
  one << "},\"vertices\":[" << shared.vertices() << "]}";
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void measure(const char* name, const fs::path& file) {
  city::ReadOptions options;
  options.threads = 1;
  double best = 1e30;
  std::size_t polygons = 0;
  const double before = peak_mb();
  for (int round = 0; round < 3; ++round) {
    const double start = cpu_seconds();
    inputs::read_city_head(file);  // as every bake does
    polygons = inputs::read_city(file, options, [](city::CityObject&&) {}).polygons;
    best = std::min(best, cpu_seconds() - start);
  }
  const double megabytes = static_cast<double>(fs::file_size(file)) / 1e6;
  std::printf("%-12s %8.1f MB %8.3f CPU s %8.0f MB/s %10.0f polygons/s  peak +%.0f MB\n", name,
              megabytes, best, megabytes / best, static_cast<double>(polygons) / best,
              peak_mb() - before);
}

int run(int argc, char** argv) {
  fs::path file;
  int copies = 1;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--copies" && i + 1 < argc)
      copies = std::atoi(argv[++i]);
    else
      file = argv[i];
  }
  if (file.empty() || copies < 1) {
    std::fprintf(stderr, "usage: cityjson_bench CITY.gml [--copies N] | CITY.json\n");
    return 2;
  }
  if (file.extension() != ".gml") {
    measure(file.filename().c_str(), file);
    return 0;
  }
  const fs::path folder = fs::temp_directory_path() / "nightcity_cityjson_bench";
  fs::create_directories(folder);
  {
    std::vector<city::CityObject> objects;
    inputs::read_city(file, {}, [&](city::CityObject&& o) {
      if (!o.polygons.empty()) objects.push_back(std::move(o));
    });
    if (objects.empty()) throw Error(file.string(), "holds no polygons");
    write_both(objects, copies, folder / "city.json", folder / "city.jsonl");
  }
  measure("CityGML", file);
  measure("CityJSONSeq", folder / "city.jsonl");
  measure("CityJSON", folder / "city.json");
  fs::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace nightcity::cityjson

int main(int argc, char** argv) {
  try {
    return nightcity::cityjson::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
