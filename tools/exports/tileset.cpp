#include "tools/exports/tileset.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "tools/bake/output_folder.h"
#include "tools/exports/place_on_earth.h"
#include "tools/exports/tile_content.h"

namespace nightcity::exports {
namespace {

using nlohmann::json;
using Cell = std::pair<int, int>;  // east, south

// A bounding region: west, south, east, north in radians, least and greatest height in m.
struct Region {
  double west = 10, south = 10, east = -10, north = -10, low = 1e9, high = -1e9;

  void add(const glm::dvec2& lon_lat, double low_m, double high_m) {
    const glm::dvec2 p = glm::radians(lon_lat);
    west = std::min(west, p.x), east = std::max(east, p.x);
    south = std::min(south, p.y), north = std::max(north, p.y);
    low = std::min(low, low_m), high = std::max(high, high_m);
  }
  void add(const Region& other) {
    west = std::min(west, other.west), east = std::max(east, other.east);
    south = std::min(south, other.south), north = std::max(north, other.north);
    low = std::min(low, other.low), high = std::max(high, other.high);
  }
  json to_json() const { return {{"region", {west, south, east, north, low, high}}}; }
};

struct Leaf {
  Region region;
  json tile;
};

class TilesetWriter {
 public:
  TilesetWriter(const Scene& scene, const LightFile* lights, const std::filesystem::path& folder,
                const TilesetOptions& options)
      : scene_(scene),
        lights_(lights),
        folder_(folder),
        options_(options),
        earth_(scene.georeference.crs, scene.georeference.origin, options.geoid_m) {}
  TilesetReport write() {
    sort_nodes();
    sort_lamps();
    if (cells_.empty()) throw Error(folder_.string(), "the scene has nothing to show");
    if (std::error_code error; std::filesystem::exists(folder_ / "tileset.json", error))
      throw UsageError((folder_ / "tileset.json").string(), "is there already");
    bake::OutputFolder output(folder_);
    // The first, which appears last: it names the others.
    const std::filesystem::path tileset_path = output.staged("tileset.json");
    for (const auto& [cell, parts] : cells_) leaves_[cell] = write_leaf(cell, parts, output);
    json root = make_tree();
    const double error = 2 * root["geometricError"].get<double>();
    json tileset = {{"asset", {{"version", "1.1"}, {"generator", "nightcity"}}},
                    {"geometricError", error},
                    {"root", std::move(root)}};
    AtomicFile file(tileset_path);
    file.write(tileset.dump(1));
    file.commit();
    output.commit();
    return report_;
  }

 private:
  Cell find_cell(const glm::dvec3& place) const {
    return {static_cast<int>(std::floor(place.x / options_.cell_m)),
            static_cast<int>(std::floor(place.z / options_.cell_m))};
  }

  void sort_nodes() {
    std::vector<ModelBox> boxes(scene_.meshes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (const ScenePrimitive& primitive : scene_.meshes[i].primitives)
        for (const glm::vec3& p : primitive.positions) boxes[i].add(p);
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      const SceneNode& node = scene_.nodes[n];
      const ModelBox& box = boxes[node.mesh];
      if (node.kind == "vehicle") {
        ++report_.vehicles;
        continue;
      }
      if (node.kind == "horizon") continue;  // globes have a ground of their own
      if (!(box.least.x <= box.greatest.x)) continue;
      for (std::size_t i = 0; i < node.instances.size(); ++i) {
        ModelBox placed;
        for (int corner = 0; corner < 8; ++corner) {
          const glm::vec4 p(corner & 1 ? box.least.x : box.greatest.x,
                            corner & 2 ? box.least.y : box.greatest.y,
                            corner & 4 ? box.least.z : box.greatest.z, 1);
          placed.add(glm::dvec3(node.instances[i].to_model * p));
        }
        TileParts& tile = cells_[find_cell((placed.least + placed.greatest) / 2.0)];
        tile.parts.push_back({n, i});
        tile.box.add(placed.least);
        tile.box.add(placed.greatest);
      }
    }
  }

  void sort_lamps() {
    if (!lights_) return;
    const auto provenance = lights_->provenance();
    for (std::size_t i = 0; i < lights_->lights().size(); ++i) {
      if (i < provenance.size() &&
          provenance[i].family != static_cast<std::uint8_t>(LightFamily::lamp))
        continue;
      const glm::dvec3 place(lights_->lights()[i].position);
      TileParts& tile = cells_[find_cell(place)];
      tile.lamps.push_back(i);
      tile.box.add(place);
    }
  }

  Leaf write_leaf(const Cell& cell, const TileParts& parts, bake::OutputFolder& output) {
    const glm::dvec3 origin((cell.first + 0.5) * options_.cell_m, std::floor(parts.box.least.y),
                            (cell.second + 0.5) * options_.cell_m);
    const std::string name =
        "tiles/" + std::to_string(cell.first) + "_" + std::to_string(cell.second) + ".glb";
    write_tile(scene_, lights_, parts, origin, output.staged(name), options_, report_);
    Leaf leaf;
    leaf.region = find_region(parts.box);
    const glm::dvec3 place = scene_.georeference.from_model(origin);
    leaf.tile = {{"boundingVolume", leaf.region.to_json()},
                 {"geometricError", 0},
                 {"transform", earth_.make_transform(place)},
                 {"content", {{"uri", name}}}};
    return leaf;
  }

  // Edges of a cell are no lines of latitude or longitude: points on them are looked at, and some
  // metres are added.
  Region find_region(const ModelBox& box) const {
    Region region;
    constexpr int steps = 4;
    constexpr double margin_m = 1;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j) {
        const glm::dvec3 t(static_cast<double>(i) / steps, 0, static_cast<double>(j) / steps);
        const glm::dvec3 place = scene_.georeference.from_model(
            box.least - margin_m + t * (box.greatest - box.least + 2 * margin_m));
        region.add(earth_.to_lon_lat(glm::dvec2(place)),
                   earth_.to_ellipsoid(scene_.georeference.origin.z + box.least.y - margin_m),
                   earth_.to_ellipsoid(scene_.georeference.origin.z + box.greatest.y + margin_m));
      }
    return region;
  }

  // Four tiles make one of twice the side, which has no content of its own, until there is one.
  json make_tree() {
    double side_m = options_.cell_m;
    while (leaves_.size() > 1 || side_m == options_.cell_m) {
      std::map<Cell, Leaf> parents;
      for (auto& [cell, leaf] : leaves_) {
        const auto half = [](int i) { return i >> 1; };  // rounds down
        Leaf& parent = parents[{half(cell.first), half(cell.second)}];
        parent.region.add(leaf.region);
        parent.tile["children"].push_back(std::move(leaf.tile));
      }
      for (auto& [cell, parent] : parents) {
        parent.tile["boundingVolume"] = parent.region.to_json();
        parent.tile["geometricError"] = side_m;
        parent.tile["refine"] = "ADD";
      }
      leaves_ = std::move(parents);
      side_m *= 2;
      if (join_round_origin(leaves_)) break;
    }
    return std::move(leaves_.begin()->second.tile);
  }

  // Cells on both sides of the origin stay apart however often they are halved: -1 and 0 are then
  // joined at once.
  bool join_round_origin(std::map<Cell, Leaf>& leaves) const {
    if (leaves.size() < 2 || !std::all_of(leaves.begin(), leaves.end(), [](const auto& entry) {
          const Cell& cell = entry.first;
          return cell.first >= -1 && cell.first <= 0 && cell.second >= -1 && cell.second <= 0;
        }))
      return false;
    Leaf root;
    double error = 0;
    for (auto& [cell, leaf] : leaves) {
      root.region.add(leaf.region);
      error = std::max(error, leaf.tile["geometricError"].get<double>());
      root.tile["children"].push_back(std::move(leaf.tile));
    }
    root.tile["boundingVolume"] = root.region.to_json();
    root.tile["geometricError"] = 2 * error;
    root.tile["refine"] = "ADD";
    leaves.clear();
    leaves[{0, 0}] = std::move(root);
    return true;
  }

  const Scene& scene_;
  const LightFile* lights_;
  std::filesystem::path folder_;
  TilesetOptions options_;
  PlaceOnEarth earth_;
  std::map<Cell, TileParts> cells_;
  std::map<Cell, Leaf> leaves_;
  TilesetReport report_;
};

}  // namespace

TilesetReport write_tileset(const Scene& scene, const LightFile* lights,
                            const std::filesystem::path& folder, const TilesetOptions& options) {
  return TilesetWriter(scene, lights, folder, options).write();
}

}  // namespace nightcity::exports
