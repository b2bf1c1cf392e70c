#include "tools/bake/city/map_gaps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "formats/finite.h"
#include "tools/map_buildings/read_map_buildings.h"
#include "tools/mesh/classify.h"
#include "tools/mesh/close_gaps.h"
#include "tools/mesh/triangulate.h"

namespace nightcity::bake {
namespace {

// Outlines of the same house in model and map differ by a metre or so, and neighbours touch.
constexpr double max_overlap = 0.1;

enum class Fit { fits, known, beyond_ground, unusable };

const char* find_reason(Fit fit) {
  switch (fit) {
    case Fit::fits:
      return nullptr;
    case Fit::known:
      return "building that the model has";
    case Fit::beyond_ground:
      return "building beyond the ground";
    case Fit::unusable:
      return "building without area";
  }
  return nullptr;
}

class GapFinder {
 public:
  GapFinder(const georeference::CityFrame& frame, const terrain::Terrain& terrain,
            const city::PolygonLimits& limits)
      : frame_(frame), terrain_(terrain), limits_(limits) {}

  // Places the object in the city and says whether it fills a gap.
  Fit place(city::CityObject&& object, PreparedObject& out) const {
    to_city(object);
    const auto lowest = find_lowest_ground(object);
    if (!lowest) return Fit::beyond_ground;
    for_each_corner(object, [&](glm::dvec3& p) { p.z += *lowest; });
    mesh::MeshReport report;
    mesh::repair_shells(object, report);
    mesh::classify_unknown_surfaces(object);
    out.mesh = mesh::triangulate(object, report, limits_);
    out.closed = report.open_objects == 0;
    out.object = std::move(object);
    const auto overlap = find_overlap(out.mesh);
    if (!overlap) return Fit::unusable;
    return *overlap > max_overlap ? Fit::known : Fit::fits;
  }

 private:
  template <class Visit>
  static void for_each_corner(city::CityObject& object, const Visit& visit) {
    for (city::Polygon& polygon : object.polygons) {
      for (glm::dvec3& p : polygon.exterior) visit(p);
      for (city::Ring& ring : polygon.interiors)
        for (glm::dvec3& p : ring) visit(p);
    }
  }

  void to_city(city::CityObject& object) const {
    for_each_corner(
        object, [&](glm::dvec3& p) { p = glm::dvec3(frame_.from_lon_lat(glm::dvec2(p)), p.z); });
  }

  std::optional<double> find_lowest_ground(city::CityObject& object) const {
    double lowest = std::numeric_limits<double>::infinity();
    bool everywhere = true;
    for_each_corner(object, [&](glm::dvec3& p) {
      if (!everywhere) return;
      const auto height = finite(p)
                              ? terrain_.height_of(terrain::SurfaceClass::terrain, glm::dvec2(p))
                              : std::nullopt;
      everywhere = height.has_value();
      if (height) lowest = std::min(lowest, *height);
    });
    return everywhere && std::isfinite(lowest) ? std::optional(lowest) : std::nullopt;
  }

  // Returns the share of the roof, in plan, that lies on buildings of the model, from four places
  // in each triangle.
  std::optional<double> find_overlap(const mesh::TriangleMesh& mesh) const {
    double whole = 0, inside = 0;
    for (const mesh::MeshTriangle& triangle : mesh.triangles) {
      if (triangle.surface != city::SurfaceType::roof) continue;
      const glm::dvec2 a(mesh.positions[triangle.vertex[0]]), b(mesh.positions[triangle.vertex[1]]),
          c(mesh.positions[triangle.vertex[2]]), middle = (a + b + c) / 3.0;
      const double area = std::abs((b - a).x * (c - a).y - (b - a).y * (c - a).x) / 2;
      whole += area;
      for (const glm::dvec2& p :
           {middle, (middle + a) / 2.0, (middle + b) / 2.0, (middle + c) / 2.0})
        if (terrain_.inside_building(p)) inside += area / 4;
    }
    return whole > 0 ? std::optional(inside / whole) : std::nullopt;
  }

  const georeference::CityFrame& frame_;
  const terrain::Terrain& terrain_;
  city::PolygonLimits limits_;
};

struct Batch {
  std::vector<CityConsumer::Turn> turns;  // of the buildings that fit, in order
  std::vector<std::shared_ptr<const PreparedObject>> buildings;
  std::map<std::string, std::size_t> left_out;
};

}  // namespace

void fill_gaps(const std::filesystem::path& map, const city::ReadOptions& options,
               const georeference::CityFrame& frame, const terrain::Terrain& terrain,
               std::span<CityConsumer* const> consumers, CityConsumer& ground, GapReport& report) {
  const GapFinder finder(frame, terrain, options.polygon);
  // The terrain is asked on many threads until the map ends, and must not change meanwhile.
  std::vector<CityConsumer::Turn> ground_turns;
  const auto stage = [&](std::vector<city::CityObject>&& objects) -> std::function<void()> {
    const auto batch = std::make_shared<Batch>();
    for (city::CityObject& object : objects) {
      const auto prepared = std::make_shared<PreparedObject>();
      const Fit fit = finder.place(std::move(object), *prepared);
      if (const char* reason = find_reason(fit)) {
        ++batch->left_out[reason];
        continue;
      }
      batch->buildings.push_back(prepared);
      for (CityConsumer* consumer : consumers)
        if (auto turn = consumer->prepare(prepared)) batch->turns.push_back(std::move(turn));
    }
    return [&, batch] {
      for (const auto& [reason, count] : batch->left_out) report.left_out[reason] += count;
      report.buildings += batch->buildings.size();
      for (const CityConsumer::Turn& turn : batch->turns) turn(false);
      for (const auto& building : batch->buildings)
        if (auto turn = ground.prepare(building)) ground_turns.push_back(std::move(turn));
    };
  };
  const city::ReadReport read = map_buildings::read_map_buildings(map, options, stage);
  for (const auto& [reason, count] : read.skipped) report.left_out[reason] += count;
  for (const auto& [what, count] : read.assumed) report.assumed[what] += count;
  for (const CityConsumer::Turn& turn : ground_turns) turn(false);
}

}  // namespace nightcity::bake
