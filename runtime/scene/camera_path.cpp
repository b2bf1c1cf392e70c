#include "runtime/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/json_parse.h"
#include "formats/small_file.h"
#include "runtime/scene/trace_ray.h"

namespace nightcity::scene {
namespace {

// Returns a point between b and c (Catmull, Rom: A class of local interpolating splines, 1974;
// uniform).
glm::dvec3 on_curve(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    const glm::dvec3& d, double t) {
  return 0.5 * (2.0 * b +
                t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a))));
}

std::vector<CameraPose> orbit(const CameraPose& start) {
  constexpr int steps = 8;
  std::vector<CameraPose> poses;
  const glm::vec3 arm = start.position - start.target;
  for (int i = 0; i <= steps; ++i) {
    const float angle = 1.5707963f * float(i) / steps, c = std::cos(angle), s = std::sin(angle);
    poses.push_back(start);
    poses.back().position =
        start.target + glm::vec3(c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x);
  }
  return poses;
}

// Returns a path straight ahead: 60 m at most, or four fifths of the way to what blocks the view.
std::vector<CameraPose> along_the_view(const CameraPose& start, const RenderScene& scene) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(start.target - start.position));
  const auto wall = trace_ray(scene, glm::dvec3(start.position), forward, 75, MASK_VISIBLE);
  const double way = std::max(0.0, (wall ? wall->distance : 75.0) * 0.8);
  std::vector<CameraPose> poses{start, start};
  poses[1].position += glm::vec3(forward * way);
  poses[1].target += glm::vec3(forward * way);
  return poses;
}

}  // namespace

CameraPath::CameraPath(std::vector<CameraPose> poses) : poses_(std::move(poses)) {
  if (poses_.empty()) throw Error("", "a camera path has at least one pose");
}

CameraPose CameraPath::at(double u) const {
  const auto last = static_cast<std::ptrdiff_t>(poses_.size()) - 1;
  const double along = std::clamp(u, 0.0, 1.0) * double(last);
  const auto i =
      std::min(static_cast<std::ptrdiff_t>(along), std::max<std::ptrdiff_t>(0, last - 1));
  const double t = along - double(i);
  const auto pose = [&](std::ptrdiff_t k) -> const CameraPose& {
    return poses_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k, 0, last))];
  };
  const auto curve = [&](glm::vec3 CameraPose::*value) {
    return glm::vec3(on_curve(glm::dvec3(pose(i - 1).*value), glm::dvec3(pose(i).*value),
                              glm::dvec3(pose(i + 1).*value), glm::dvec3(pose(i + 2).*value), t));
  };
  CameraPose result = pose(t < 0.5 ? i : i + 1);
  result.position = curve(&CameraPose::position);
  result.target = curve(&CameraPose::target);
  return result;
}

CameraPath find_path(const std::string& preset_or_file, const RenderScene& scene) {
  if (preset_or_file == "orbit") return CameraPath(orbit(find_camera("overview", scene)));
  if (preset_or_file == "dive")
    return CameraPath({find_camera("overview", scene), find_camera("street", scene)});
  if (preset_or_file == "street")
    return CameraPath(along_the_view(find_camera("street", scene), scene));
  return CameraPath(read_poses(preset_or_file, scene.origin));
}

std::vector<CameraPose> read_poses(const std::filesystem::path& file, const glm::dvec3& origin) {
  const std::string name = file.string();
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw Error(name, "is neither a path file nor one of orbit, dive, street");
  try {
    const auto document = parse_json(read_small_file(file), name);
    std::vector<CameraPose> poses;
    for (const auto& entry : document.at("poses"))
      poses.push_back(parse_camera(entry.dump(), name, origin));
    return poses;
  } catch (const nlohmann::json::exception& error) {
    throw Error(name, describe(error));
  }
}

void write_poses(const std::filesystem::path& file, const std::vector<CameraPose>& poses) {
  std::string text = "{\"poses\": [";
  for (std::size_t i = 0; i < poses.size(); ++i)
    text += (i > 0 ? ",\n  " : "\n  ") + to_text(poses[i]);
  AtomicFile out(file);
  out.write(text + "\n]}\n");
  out.commit();
}

const std::vector<std::string>& path_presets() {
  static const std::vector<std::string> names{"orbit", "dive", "street"};
  return names;
}

}  // namespace nightcity::scene
