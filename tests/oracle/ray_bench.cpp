// Not a test: how many rays a second our traversal and Embree's single rays trace on the CPU.
//   ray_bench SCENE.glb [CAMERA]
// Both trace the same rays of `nightview rays` in turns, on all cores: ours on Mesa's CPU driver, a
// shader, Embree's rtcIntersect1 and rtcOccluded1 on as many threads. Prints the rates, their
// ratio, and for how many rays both agree on whether there is a hit.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <iostream>
#include <string>

#include "formats/median.h"
#include "formats/parallel.h"
#include "runtime/experiments/ray_set.h"
#include "runtime/render/ray_probe.h"

namespace nightcity {
namespace {

constexpr std::uint32_t width = 480, height = 270, repeats = 9;
constexpr std::size_t at_once = 1024;  // rays of a task

// All triangles of a scene's instances that share a bit with `mask`, in model space.
class EmbreeScene {
 public:
  EmbreeScene(const scene::RenderScene& scene, std::uint32_t mask) : scene_(rtcNewScene(device_)) {
    std::vector<glm::vec3> corners;
    for (const gpu::Instance& instance : scene.instances) {
      if ((instance.mask & mask) == 0) continue;
      for (const scene::Mesh& mesh : scene.meshes)
        if (mesh.root == instance.root) append(scene, instance, mesh, corners);
    }
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* to = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), corners.size()));
    auto* index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), corners.size() / 3));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      to[i] = corners[i];
      index[i] = static_cast<std::uint32_t>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Sets which rays hit, and returns the milliseconds.
  double trace(std::span<const gpu::ProbeRay> rays, bool any_hit, std::vector<char>& hits) const {
    const auto start = std::chrono::steady_clock::now();
    run_parallel((rays.size() + at_once - 1) / at_once, count_cores(), [&](std::size_t task) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      for (std::size_t i = task * at_once; i < std::min(rays.size(), (task + 1) * at_once); ++i) {
        const gpu::ProbeRay& r = rays[i];
        RTCRayHit ray{};
        ray.ray = {r.from.x, r.from.y, r.from.z, 0,   r.way.x, r.way.y,
                   r.way.z,  0,        r.t_max,  ~0u, 0,       0};
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        if (any_hit)
          rtcOccluded1(scene_, &context, &ray.ray);
        else
          rtcIntersect1(scene_, &context, &ray);
        hits[i] = any_hit ? ray.ray.tfar < 0 : ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      }
    });
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    return ms.count();
  }

 private:
  static void append(const scene::RenderScene& scene, const gpu::Instance& instance,
                     const scene::Mesh& mesh, std::vector<glm::vec3>& corners) {
    glm::dmat4 to_object(1);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        to_object[column][row] = double(instance.to_object[row][column]);
    const glm::dmat4 to_model = glm::inverse(to_object);
    for (std::uint32_t i = 0; i < mesh.triangles; ++i) {
      const gpu::Triangle t = scene.triangles[mesh.first_triangle + i];
      for (const glm::vec3& corner : {t.v0, t.v1, t.v2})
        corners.push_back(glm::vec3(to_model * glm::dvec4(corner, 1)));
    }
  }

  RTCDevice device_ = rtcNewDevice(nullptr);
  RTCScene scene_;
};

void compare(const char* kind, gpu::Device& device, render::PassLibrary& library,
             render::DeviceScene& device_scene, const EmbreeScene& embree,
             const std::vector<gpu::ProbeRay>& rays, bool any_hit) {
  std::vector<char> hits(rays.size());
  std::vector<double> ours, theirs;
  render::TracedRays traced;
  for (std::uint32_t i = 0; i < repeats; ++i) {
    traced = render::trace_rays(device, library, device_scene, rays, any_hit, 1);
    ours.push_back(traced.ms[0]);
    theirs.push_back(embree.trace(rays, any_hit, hits));
  }
  std::size_t agree = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    agree += (traced.distances[i] >= 0) == (hits[i] != 0);
  const double a = double(rays.size()) / median(ours) / 1000,
               b = double(rays.size()) / median(theirs) / 1000;
  fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.3f} | {:.4f} % |\n", kind, rays.size(), a, b, a / b,
             100 * double(agree) / double(rays.size()));
}

void run(const std::string& file, const std::string& camera) {
  // Vehicles move, and are met by neither.
  const scene::RenderScene scene =
      scene::load_render_scene(file, scene::PartSet().set(std::size_t(scene::Part::traffic)));
  const auto primary =
      experiments::make_primary_rays(scene::find_camera(camera, scene), width, height);
  const auto shadow = experiments::make_shadow_rays(scene, primary);
  gpu::Device device({.select = "llvmpipe"});
  render::DeviceScene device_scene(device, scene);
  render::PassLibrary library(device);
  fmt::print(
      "| rays | number | ours, million a s | Embree | ratio | agree |\n"
      "|---|---:|---:|---:|---:|---:|\n");
  compare("primary", device, library, device_scene, EmbreeScene(scene, MASK_VISIBLE), primary,
          false);
  if (!shadow.empty())
    compare("shadow", device, library, device_scene, EmbreeScene(scene, MASK_SHADOW), shadow, true);
}

}  // namespace
}  // namespace nightcity

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "ray_bench SCENE.glb [CAMERA]\n";
    return 2;
  }
  try {
    nightcity::run(argv[1], argc > 2 ? argv[2] : "street");
  } catch (const std::exception& error) {
    std::cerr << "ray_bench: " << error.what() << "\n";
    return 1;
  }
}
