#include "runtime/scene/trace_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace nightcity::scene {
namespace {

struct Ray {
  glm::dvec3 origin, direction, inverse;
};

Ray make_ray(const glm::dvec3& origin, const glm::dvec3& direction) {
  Ray ray{origin, direction, {}};
  for (int axis = 0; axis < 3; ++axis)
    ray.inverse[axis] =
        1 / (std::abs(direction[axis]) < 1e-20 ? std::copysign(1e-20, direction[axis])
                                               : direction[axis]);
  return ray;
}

double byte_of(std::uint32_t word, int i) {
  return double(word >> (8 * i) & 255u);
}

// Returns the distance at which the ray enters a child's box, infinity where it misses the box.
double enter(const gpu::BvhNode& node, int child, const Ray& ray, double t_max) {
  double near = 0, far = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = std::exp2(byte_of(node.exponents, axis) - 127);
    const double origin = double(node.origin[axis]) - ray.origin[axis];
    const double a = (origin + step * byte_of(node.lower[axis], child)) * ray.inverse[axis];
    const double b = (origin + step * byte_of(node.upper[axis], child)) * ray.inverse[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b) * (1 + 1e-12));
  }
  return near <= far ? near : std::numeric_limits<double>::infinity();
}

// Intersects as Möller and Trumbore (Fast, minimum storage ray/triangle intersection, 1997).
std::optional<double> hit_triangle(const gpu::Triangle& triangle, const Ray& ray, double t_max) {
  const glm::dvec3 v0(triangle.v0), e1 = glm::dvec3(triangle.v1) - v0,
                                    e2 = glm::dvec3(triangle.v2) - v0;
  const glm::dvec3 p = glm::cross(ray.direction, e2);
  const double determinant = glm::dot(e1, p);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 s = ray.origin - v0;
  const double u = glm::dot(s, p) / determinant;
  const glm::dvec3 q = glm::cross(s, e1);
  const double v = glm::dot(ray.direction, q) / determinant;
  const double t = glm::dot(e2, q) / determinant;
  if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < t_max) return t;
  return std::nullopt;
}

// Goes through the hierarchy below `root`, nearer children first, and calls `leaf` with each leaf
// (gpu::BvhNode::child), which may shorten `t_max`.
template <class Leaf>
void traverse(const RenderScene& scene, std::uint32_t root, const Ray& ray, std::uint32_t mask,
              double& t_max, Leaf leaf) {
  if (root == BVH_EMPTY) return;
  std::array<std::uint32_t, BVH_STACK + 4> stack;
  std::size_t top = 0;
  stack[top++] = root;
  while (top > 0) {
    const std::uint32_t node = stack[--top];
    if (node & BVH_LEAF) {
      leaf(node);
      continue;
    }
    const gpu::BvhNode& box = scene.nodes[node];
    constexpr double missed = std::numeric_limits<double>::infinity();
    std::array<double, 4> entered;
    for (int child = 0; child < 4; ++child)
      entered[std::size_t(child)] =
          box.child[child] == BVH_EMPTY || (box.masks >> (8 * child) & mask) == 0
              ? missed
              : enter(box, child, ray, t_max);
    // The farthest first, so that the nearest lies on top.
    for (int i = 0; i < 4; ++i) {
      const auto farthest = std::max_element(
          entered.begin(), entered.end(),
          [](double x, double y) { return (x == missed ? -1 : x) < (y == missed ? -1 : y); });
      if (*farthest == missed) break;
      stack[top++] = box.child[farthest - entered.begin()];
      *farthest = missed;
    }
  }
}

}  // namespace

std::optional<RayHit> trace_ray(const RenderScene& scene, const glm::dvec3& origin,
                                const glm::dvec3& direction, double t_max, std::uint32_t mask) {
  std::optional<RayHit> nearest;
  const auto hit_leaf = [&](std::uint32_t leaf, const Ray& local, std::uint32_t instance) {
    const std::uint32_t first = leaf & BVH_LEAF_FIRST_MASK,
                        count = ((leaf & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1;
    for (std::uint32_t position = first; position < first + count; ++position) {
      const std::uint32_t triangle = scene.triangle_order[position];
      const auto t = hit_triangle(scene.triangles[triangle], local, t_max);
      if (!t) continue;
      t_max = *t;
      nearest = RayHit{*t, instance, triangle, {}};
    }
  };
  const hierarchy::BoxFrame frame{scene.boxes_along};
  const Ray ray = make_ray(origin, direction),
            in_boxes = make_ray(frame.turn(origin), frame.turn(direction));
  const auto enter_leaf = [&](std::uint32_t leaf) {
    if (!(leaf & BVH_INSTANCE)) return hit_leaf(leaf, ray, STATIC_INSTANCE);
    const std::uint32_t i = leaf & BVH_LEAF_FIRST_MASK;
    const gpu::Instance& instance = scene.instances[i];
    if ((instance.mask & mask) == 0) return;
    const auto apply = [&](const glm::dvec3& v, double w) {
      glm::dvec3 result;
      for (int row = 0; row < 3; ++row)
        result[row] = glm::dot(glm::dvec3(instance.to_object[row]), v) +
                      double(instance.to_object[row].w) * w;
      return result;
    };
    const Ray local = make_ray(apply(origin, 1), apply(direction, 0));
    traverse(scene, instance.root, local, ~0u, t_max,
             [&](std::uint32_t below) { hit_leaf(below, local, i); });
  };
  for (const std::uint32_t root : {scene.root, scene.horizon.root})
    traverse(scene, root, in_boxes, mask, t_max, enter_leaf);
  if (!nearest) return nearest;
  const gpu::Triangle& triangle = scene.triangles[nearest->triangle];
  const gpu::Instance& instance = scene.instances[nearest->instance];
  const glm::dvec3 local = glm::cross(glm::dvec3(triangle.v1) - glm::dvec3(triangle.v0),
                                      glm::dvec3(triangle.v2) - glm::dvec3(triangle.v0));
  // Normals go to model space by the transpose of the map from there.
  glm::dvec3 normal(0);
  for (int row = 0; row < 3; ++row) normal += local[row] * glm::dvec3(instance.to_object[row]);
  normal = glm::normalize(normal);
  nearest->normal = glm::dot(normal, direction) > 0 ? -normal : normal;
  return nearest;
}

}  // namespace nightcity::scene
