#include "tools/traffic/bodies.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "formats/colour.h"
#include "tools/traffic/vehicle_lamps.h"

namespace nightcity::traffic {
namespace {

constexpr double lens_height_m = 0.12, lens_width_m = 0.18;
constexpr float lens_gap = 0.005f;  // in front of the body, so that the two do not flicker

/// One material's triangles.
class Part {
 public:
  explicit Part(std::uint32_t material) { primitive.material = material; }

  /// Adds a quad whose front faces away from `inside`.
  void quad(std::array<glm::vec3, 4> p, const glm::vec3& inside) {
    const glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    if (glm::dot(normal, p[0] - inside) < 0) std::swap(p[1], p[3]);
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    primitive.positions.insert(primitive.positions.end(), p.begin(), p.end());
    for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) primitive.indices.push_back(first + k);
  }

  ScenePrimitive primitive;
};

struct Slab {
  float rear, front, half;  // at one height
};

/// Six faces between a lower and an upper rectangle; sides and top may be of different parts.
void block(Part& sides, Part& top, const Slab& low, float y0, const Slab& high, float y1) {
  const auto corner = [](const Slab& s, float y, bool front, bool right) {
    return glm::vec3(front ? s.front : s.rear, y, right ? s.half : -s.half);
  };
  const glm::vec3 middle((low.rear + low.front) / 2, (y0 + y1) / 2, 0);
  const auto a = [&](bool front, bool right) { return corner(low, y0, front, right); };
  const auto b = [&](bool front, bool right) { return corner(high, y1, front, right); };
  sides.quad({a(true, false), a(true, true), b(true, true), b(true, false)}, middle);
  sides.quad({a(false, false), a(false, true), b(false, true), b(false, false)}, middle);
  for (const bool right : {false, true})
    sides.quad({a(false, right), a(true, right), b(true, right), b(false, right)}, middle);
  top.quad({b(false, false), b(true, false), b(true, true), b(false, true)}, middle);
  sides.quad({a(false, false), a(true, false), a(true, true), a(false, true)}, middle);
}

/// Adds an eight-sided wheel whose axle lies along z.
void wheel(Part& part, float x, float radius, float z0, float z1) {
  const glm::vec3 middle(x, radius, (z0 + z1) / 2);
  std::array<glm::vec2, 8> rim;
  for (std::size_t k = 0; k < 8; ++k) {
    const double angle = (static_cast<double>(k) + 0.5) * std::numbers::pi / 4;
    // The lowest points touch the road.
    const double r = static_cast<double>(radius) / std::cos(std::numbers::pi / 8);
    rim[k] = {static_cast<float>(x + r * std::cos(angle)),
              static_cast<float>(radius + r * std::sin(angle))};
  }
  for (std::size_t k = 0; k < 8; ++k) {
    const glm::vec2 p = rim[k], q = rim[(k + 1) % 8];
    part.quad({glm::vec3(p, z0), glm::vec3(q, z0), glm::vec3(q, z1), glm::vec3(p, z1)}, middle);
  }
  for (const float z : {z0, z1})
    for (const std::size_t k : {std::size_t{0}, std::size_t{2}, std::size_t{4}})
      part.quad({glm::vec3(rim[0], z), glm::vec3(rim[k + 1], z), glm::vec3(rim[k + 2], z),
                 glm::vec3(rim[(k + 3) % 8], z)},
                middle);
}

void lens(Part& part, float x, float y, float z) {
  const float dy = static_cast<float>(lens_height_m / 2), dz = static_cast<float>(lens_width_m / 2);
  part.quad({glm::vec3(x, y - dy, z - dz), glm::vec3(x, y - dy, z + dz),
             glm::vec3(x, y + dy, z + dz), glm::vec3(x, y + dy, z - dz)},
            {0, y, z});
}

struct Parts {
  Part paint, glass, tyre, headlamp, tail_lamp;
};

void add_car(Parts& p, float l, float w, float h) {
  const float belt = 0.58f * h;
  block(p.paint, p.paint, {-l, l, w}, 0.16f * h, {-l, l, w}, 0.40f * h);
  block(p.paint, p.paint, {-l, l, w}, 0.40f * h, {-0.97f * l, 0.93f * l, 0.97f * w}, belt);
  block(p.glass, p.paint, {-0.85f * l, 0.45f * l, 0.93f * w}, belt,
        {-0.60f * l, 0.12f * l, 0.76f * w}, h);
}

void add_box_body(Parts& p, float l, float w, float h, float floor, float nose) {
  // Nose and windscreen first, then the box behind them.
  const float belt = floor + 0.42f * (h - floor);
  block(p.paint, p.paint, {-l, l, w}, floor, {-l, l, w}, belt);
  block(p.glass, p.paint, {l - 1.6f * nose, l, w}, belt, {l - 1.6f * nose, l - nose, 0.95f * w},
        0.94f * h);
  block(p.paint, p.paint, {-l, l - 1.6f * nose, w}, belt, {-l, l - 1.6f * nose, w}, h);
}

void add_bus(Parts& p, float l, float w, float h) {
  block(p.paint, p.paint, {-l, l, w}, 0.3f, {-l, l, w}, 1.1f);
  block(p.glass, p.glass, {-l + 0.05f, l - 0.02f, w - 0.03f}, 1.1f,
        {-l + 0.05f, l - 0.15f, w - 0.03f}, h - 0.5f);
  block(p.paint, p.paint, {-l, l - 0.1f, w}, h - 0.5f, {-l, l - 0.15f, w - 0.05f}, h);
}

void add_lorry(Parts& p, float l, float w, float h) {
  const float cab = 2.2f;
  block(p.paint, p.paint, {l - cab, l, w}, 0.5f, {l - cab, l, w}, 1.6f);
  block(p.glass, p.paint, {l - cab, l - 0.02f, w - 0.05f}, 1.6f, {l - cab, l - 0.15f, w - 0.1f},
        2.6f);
  block(p.tyre, p.tyre, {-l, l - cab, 0.4f * w}, 0.6f, {-l, l - cab, 0.4f * w}, 1.0f);
  block(p.paint, p.paint, {-l, l - cab - 0.2f, w}, 1.0f, {-l, l - cab - 0.2f, w}, h);
}

void add_motorcycle(Parts& p, float l, float w, float h) {
  block(p.paint, p.paint, {-0.7f * l, 0.95f * l, 0.18f}, 0.45f, {-0.9f * l, l, 0.22f}, 0.95f);
  block(p.tyre, p.tyre, {-0.45f * l, 0.1f * l, 0.25f}, 0.8f, {-0.35f * l, 0.2f * l, w},
        1.2f);  // rider
  block(p.glass, p.glass, {-0.1f * l, 0.15f * l, 0.13f}, 1.2f, {-0.05f * l, 0.12f * l, 0.10f},
        h);  // helmet
  wheel(p.tyre, 0.68f * l, 0.3f, -0.08f, 0.08f);
  wheel(p.tyre, -0.68f * l, 0.3f, -0.08f, 0.08f);
}

}  // namespace

std::vector<SceneMaterial> body_materials(const VehicleType& type) {
  const double area = lens_height_m * lens_width_m;
  const glm::vec3 white = rec709_from_xy(planckian_xy(type.headlamp_cct_k)),
                  red = rec709_from_xy({0.6915, 0.3083});
  const auto head = static_cast<float>(low_beam_flux_lm() / (std::numbers::pi * area));
  const auto tail = static_cast<float>(tail_lamp_cd / area);
  const std::string name = type.name;
  return {
      {.name = name + " paint",
       .base_colour = {type.paint[0], type.paint[1], type.paint[2]},
       .roughness = 0.5f},
      {.name = "vehicle glass", .base_colour = glm::vec3(0.04f), .roughness = 0.2f},
      {.name = "tyre", .base_colour = glm::vec3(0.03f)},
      {.name = name + " headlamp", .base_colour = glm::vec3(0.5f), .emission_cd_m2 = white * head},
      {.name = "tail lamp", .base_colour = {0.3f, 0.02f, 0.02f}, .emission_cd_m2 = red * tail}};
}

SceneMesh make_body(const VehicleType& type, const BodyMaterials& materials) {
  Parts parts{Part(materials.paint), Part(materials.glass), Part(materials.tyre),
              Part(materials.headlamp), Part(materials.tail_lamp)};
  const auto l = static_cast<float>(type.length_m / 2), w = static_cast<float>(type.width_m / 2),
             h = static_cast<float>(type.height_m);
  switch (type.shape) {
    case Shape::car:
      add_car(parts, l, w, h);
      break;
    case Shape::van:
      add_box_body(parts, l, w, h, 0.35f, 0.7f);
      break;
    case Shape::bus:
      add_bus(parts, l, w, h);
      break;
    case Shape::lorry:
      add_lorry(parts, l, w, h);
      break;
    case Shape::motorcycle:
      add_motorcycle(parts, l, w, h);
      break;
  }
  const float radius = type.large ? 0.48f : 0.32f;
  if (type.shape != Shape::motorcycle)
    for (const float x : {-0.6f * l, 0.62f * l})
      for (const float side : {-1.0f, 1.0f})
        wheel(parts.tyre, x, radius, side * (w - 0.22f), side * (w - 0.02f));
  // One lens in front of each lamp of make_vehicle_lamps.
  const bool single = type.headlamp_apart_m == 0;
  const auto apart = static_cast<float>(type.headlamp_apart_m / 2), tails = w - 0.2f;
  const auto head_y = static_cast<float>(type.headlamp_height_m),
             tail_y = static_cast<float>(type.tail_lamp_height_m);
  if (single) {
    lens(parts.headlamp, l + lens_gap, head_y, 0);
    lens(parts.tail_lamp, -l - lens_gap, tail_y, 0);
  } else {
    for (const float side : {-1.0f, 1.0f}) {
      lens(parts.headlamp, l + lens_gap, head_y, side * apart);
      lens(parts.tail_lamp, -l - lens_gap, tail_y, side * tails);
    }
  }
  SceneMesh mesh{type.name, {}};
  for (Part* part : {&parts.paint, &parts.glass, &parts.tyre, &parts.headlamp, &parts.tail_lamp})
    if (!part->primitive.indices.empty()) mesh.primitives.push_back(std::move(part->primitive));
  return mesh;
}

}  // namespace nightcity::traffic
