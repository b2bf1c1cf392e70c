#include "oracle/oracle.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <numbers>

#include "formats/light_file.h"
#include "oracle/emitter.h"

namespace nightcity::oracle {

// Every triangle of the file in model space: once for the camera, once for shadow rays.
struct Oracle::Geometry {
  struct Triangles {
    std::vector<glm::vec3> corners;  // three a triangle
    std::vector<std::uint32_t> materials, lights;
    RTCScene scene = nullptr;
  };
  RTCDevice device = rtcNewDevice(nullptr);
  Triangles seen, casting;
  std::vector<SceneMaterial> materials;

  ~Geometry() {
    rtcReleaseScene(seen.scene);
    rtcReleaseScene(casting.scene);
    rtcReleaseDevice(device);
  }

  static void append(Triangles& out, const SceneMesh& mesh, const SceneInstance& instance) {
    const glm::dmat4 to_model(instance.to_model);
    for (const ScenePrimitive& primitive : mesh.primitives)
      for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const glm::dvec3 p(primitive.positions[primitive.indices[i + corner]]);
          out.corners.push_back(glm::vec3(glm::dvec3(to_model * glm::dvec4(p, 1.0))));
        }
        const std::uint32_t own =
            primitive.light_ids.empty() ? no_id : primitive.light_ids[primitive.indices[i]];
        out.lights.push_back(instance.light != no_id ? instance.light : own);
        out.materials.push_back(primitive.material);
      }
  }

  void commit(Triangles& triangles) {
    triangles.scene = rtcNewScene(device);
    rtcSetSceneFlags(triangles.scene, RTC_SCENE_FLAG_ROBUST);  // watertight
    const std::size_t count = triangles.materials.size();
    if (count > 0) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
          geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
      auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
          geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
      for (std::size_t i = 0; i < 3 * count; ++i) {
        for (int axis = 0; axis < 3; ++axis) *corners++ = triangles.corners[i][axis];
        *indices++ = static_cast<std::uint32_t>(i);
      }
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(triangles.scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(triangles.scene);
  }

  struct Hit {
    double distance;
    std::uint32_t triangle;
  };

  // Returns the first hit of these triangles along unit `direction`, its distance recomputed in
  // double from the triangle's plane.
  static std::optional<Hit> first_hit(const Triangles& triangles, const glm::dvec3& origin,
                                      const glm::dvec3& direction) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    set_ray(ray.ray, origin, direction, INFINITY);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(triangles.scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const glm::dvec3 a(triangles.corners[3 * ray.hit.primID]),
        n = normal(triangles, ray.hit.primID);
    const double steep = glm::dot(n, direction);
    const double distance = steep != 0 ? glm::dot(n, a - origin) / steep : double(ray.ray.tfar);
    return Hit{distance, ray.hit.primID};
  }

  bool occluded(const glm::dvec3& from, const glm::dvec3& to) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    const glm::dvec3 way = to - from;
    const double length = glm::length(way);
    // Stops a tenth of a millimetre short of the light, because its mount lies behind it.
    set_ray(ray, from, way / length, length - 1e-4);
    rtcOccluded1(casting.scene, &context, &ray);
    return ray.tfar < 0;
  }

  static glm::dvec3 normal(const Triangles& triangles, std::uint32_t triangle) {
    const glm::dvec3 a(triangles.corners[3 * triangle]), b(triangles.corners[3 * triangle + 1]),
        c(triangles.corners[3 * triangle + 2]);
    return glm::normalize(glm::cross(b - a, c - a));
  }

 private:
  static void set_ray(RTCRay& ray, const glm::dvec3& origin, const glm::dvec3& direction,
                      double far) {
    ray.org_x = float(origin.x), ray.org_y = float(origin.y), ray.org_z = float(origin.z);
    ray.dir_x = float(direction.x), ray.dir_y = float(direction.y), ray.dir_z = float(direction.z);
    ray.tnear = 0;
    ray.tfar = float(far);
    ray.mask = 0xFFFFFFFFu;
  }
};

Oracle::Oracle(const Scene& scene, Lights lights)
    : geometry_(std::make_unique<Geometry>()), lights_(std::move(lights)) {
  geometry_->materials = scene.materials;
  for (const SceneNode& node : scene.nodes)
    for (const SceneInstance& instance : node.instances) {
      Geometry::append(geometry_->seen, scene.meshes[node.mesh], instance);
      if (node.casts_shadow)
        Geometry::append(geometry_->casting, scene.meshes[node.mesh], instance);
    }
  geometry_->commit(geometry_->seen);
  geometry_->commit(geometry_->casting);
}

Oracle::~Oracle() = default;

// A point of a surface, seen from somewhere.
struct Oracle::Vertex {
  glm::dvec3 place, normal;  // the normal is on the viewer's side
  glm::dvec3 start;          // of rays that leave the surface
  glm::dvec3 albedo;
  glm::dvec3 emission;      // cd/m2 per channel
  std::uint32_t own_light;  // whose surface it is, or none of the lights
};

std::optional<Oracle::Vertex> Oracle::find_vertex(const glm::dvec3& origin,
                                                  const glm::dvec3& direction,
                                                  bool from_camera) const {
  // Light passes through what casts no shadow; cameras see it.
  const Geometry::Triangles& triangles = from_camera ? geometry_->seen : geometry_->casting;
  const auto hit = Geometry::first_hit(triangles, origin, direction);
  if (!hit) return std::nullopt;
  const SceneMaterial& material = geometry_->materials[triangles.materials[hit->triangle]];
  Vertex vertex;
  vertex.place = origin + direction * hit->distance;
  vertex.normal = Geometry::normal(triangles, hit->triangle);
  if (glm::dot(vertex.normal, direction) > 0) vertex.normal = -vertex.normal;
  // Embree works in float, so rays start off the surface by its rounding error and 0.1 mm.
  const double size = std::max({std::abs(vertex.place.x), std::abs(vertex.place.y),
                                std::abs(vertex.place.z), hit->distance});
  vertex.start = vertex.place + vertex.normal * (1e-4 + 2e-6 * size);
  vertex.albedo = glm::dvec3(material.base_colour);
  vertex.emission = glm::dvec3(material.emission_cd_m2);
  vertex.own_light = triangles.lights[hit->triangle];
  return vertex;
}

glm::dvec3 Oracle::reflect_lights(const Vertex& vertex, int strata, std::mt19937& random,
                                  const Air& air) const {
  glm::dvec3 illuminance(0);
  std::vector<LightPoint> points;
  for (const Light& light : lights_.lights) {
    if (light.flux_lm <= 0) continue;
    points.clear();
    append_points(lights_, light, vertex.place, strata, random, points);
    for (const LightPoint& sample : points) {
      const double cosine = glm::dot(vertex.normal, glm::normalize(sample.point - vertex.place));
      if (cosine > 0 && !geometry_->occluded(vertex.start, sample.point))
        illuminance += sample.illuminance * cosine * transmittance(air, sample.point, vertex.place);
    }
  }
  return vertex.albedo / std::numbers::pi * illuminance;
}

// Returns the light that a surface reflects after 1 to `bounces` bounces off others. Directions are
// uniform over the hemisphere, unlike the renderer's.
glm::dvec3 Oracle::follow_path(Vertex vertex, int bounces, std::mt19937& random,
                               const Air& air) const {
  std::uniform_real_distribution<double> uniform(0, 1);
  glm::dvec3 sum(0), throughput(1);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    const double height = 2 * uniform(random) - 1, turn = 2 * std::numbers::pi * uniform(random);
    const double radius = std::sqrt(std::max(1 - height * height, 0.0));
    glm::dvec3 direction(radius * std::cos(turn), radius * std::sin(turn), height);
    double cosine = glm::dot(direction, vertex.normal);
    if (cosine < 0) direction = -direction, cosine = -cosine;
    throughput *= vertex.albedo * 2.0 * cosine;  // albedo / pi * cosine / (1 / 2 pi)
    const auto next = find_vertex(vertex.start, direction, false);
    if (!next) break;
    throughput *= transmittance(air, vertex.place, next->place);
    vertex = *next;
    const bool is_light = vertex.own_light < lights_.lights.size();
    sum += throughput *
           (reflect_lights(vertex, 1, random, air) + (is_light ? glm::dvec3(0) : vertex.emission));
  }
  return sum;
}

// Returns the light that the air on a ray scatters to the eye.
glm::dvec3 Oracle::march(const glm::dvec3& eye, const glm::dvec3& direction, double depth,
                         std::mt19937& random, const Air& air) const {
  std::uniform_real_distribution<double> uniform(0, 1);
  const int steps = int(std::ceil(depth / air.step_m));
  const double step = depth / steps;
  glm::dvec3 sum(0);
  std::vector<LightPoint> points;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec3 place = eye + direction * ((i + uniform(random)) * step);
    const double share =
        air.albedo * extinction_at(air, place.y) * step * transmittance(air, eye, place);
    for (const Light& light : lights_.lights) {
      if (light.flux_lm <= 0) continue;
      points.clear();
      append_points(lights_, light, place, 1, random, points);
      for (const LightPoint& sample : points) {
        const glm::dvec3 to_light = glm::normalize(sample.point - place);
        if (geometry_->occluded(place, sample.point)) continue;
        sum += sample.illuminance * (share * phase(air, glm::dot(to_light, direction)) *
                                     transmittance(air, sample.point, place));
      }
    }
  }
  return sum;
}

measure::Image Oracle::render(const scene::CameraPose& pose, std::uint32_t width,
                              std::uint32_t height, int strata, unsigned seed, int bounces,
                              int paths, const Air& air) const {
  measure::Image image;
  image.width = width;
  image.height = height;
  image.rgb.reserve(3 * image.pixels());
  image.info.estimator = "oracle";
  std::mt19937 random(seed);
  const glm::dvec3 eye(pose.position), forward = glm::normalize(glm::dvec3(pose.target) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(pose.up))),
                   up = glm::cross(right, forward);
  const double half_height = std::tan(double(pose.fov_deg) / 2 * std::numbers::pi / 180);
  const double half_width = half_height * width / height;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const double sx = 2 * (x + 0.5) / width - 1, sy = 1 - 2 * (y + 0.5) / height;
      const glm::dvec3 direction =
          glm::normalize(forward + right * (sx * half_width) + up * (sy * half_height));
      glm::dvec3 radiance(0);
      if (const auto seen = find_vertex(eye, direction, true)) {
        radiance = reflect_lights(*seen, strata, random, air);
        for (int path = 0; path < paths && bounces > 0; ++path)
          radiance += follow_path(*seen, bounces, random, air) / double(paths);
        const bool shines = seen->emission.x + seen->emission.y + seen->emission.z > 0;
        if (shines && seen->own_light < lights_.lights.size())
          radiance += seen_luminance(lights_, lights_.lights[seen->own_light], -direction);
        else
          radiance += seen->emission;
        if (air.extinction > 0)
          radiance = radiance * transmittance(air, eye, seen->place) +
                     march(eye, direction, glm::length(seen->place - eye), random, air);
      }
      for (int channel = 0; channel < 3; ++channel) image.rgb.push_back(float(radiance[channel]));
    }
  return image;
}

Lights read_lights(const std::filesystem::path& path, double time_s) {
  const LightFile file = LightFile::open(path);
  Lights lights{{file.lights().begin(), file.lights().end()},
                {file.profiles().begin(), file.profiles().end()},
                {file.profile_data().begin(), file.profile_data().end()}};
  for (Light& light : lights.lights) {
    if (light.schedule == LIGHT_ALWAYS_ON) continue;
    // SPEC.md 3.6: a light is on if the number of switch times up to now is odd. Indices stay,
    // because geometry refers to them.
    const Schedule& schedule = file.schedules()[light.schedule];
    bool on = false;
    for (std::uint32_t i = 0; i < schedule.count; ++i)
      on ^= double(file.switches()[schedule.first + i]) <= time_s;
    if (!on) light.flux_lm = 0;
  }
  return lights;
}

}  // namespace nightcity::oracle
