// Roofs with one cross-section all along them.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/map_buildings/roof_shapes.h"

namespace nightcity::map_buildings {
namespace {

// A vertex of the outline. Its stripe is 2 k + 1 on the line of the profile's inner corner k, and
// 2 k below that line and above the one before.
struct Vertex {
  glm::dvec2 at;
  std::size_t stripe;
};

class Stripes {
 public:
  Stripes(const glm::dvec2& middle, const glm::dvec2& along, const RoofProfile& profile)
      : middle_(middle), across_(-along.y, along.x), corners_(profile.corners) {}

  // The outline with a vertex wherever a line of the profile cuts it. Empty where one does not cut
  // it twice.
  std::vector<Vertex> cut(const Ring2& outer) const {
    std::vector<Vertex> ring;
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const glm::dvec2 &a = outer[i], &b = outer[(i + 1) % outer.size()];
      const std::size_t from = find_stripe(a), to = find_stripe(b);
      ring.push_back({a, from});
      const double start = place_of(a), end = place_of(b);
      const auto add = [&](std::size_t k) {
        ring.push_back({a + (b - a) * ((line(k) - start) / (end - start)), 2 * k + 1});
      };
      // Line k lies between the stripes 2 k and 2 k + 2.
      for (std::size_t k = from / 2 + from % 2; from < to && 2 * k + 1 < to; ++k) add(k);
      for (std::size_t k = from / 2; to < from && k > 0 && 2 * k - 1 > to; --k) add(k - 1);
    }
    for (std::size_t k = 0; k + 2 < corners_.size(); ++k)
      if (std::count_if(ring.begin(), ring.end(),
                        [&](const Vertex& v) { return v.stripe == 2 * k + 1; }) != 2)
        return {};
    return ring;
  }

  double height_of(const Vertex& vertex) const {
    if (vertex.stripe % 2 == 1) return corners_[vertex.stripe / 2 + 1].height_m;
    const auto &low = corners_[vertex.stripe / 2], &high = corners_[vertex.stripe / 2 + 1];
    const double share = (place_of(vertex.at) - low.place_m) / (high.place_m - low.place_m);
    return low.height_m + (high.height_m - low.height_m) * std::clamp(share, 0.0, 1.0);
  }

 private:
  double place_of(const glm::dvec2& p) const { return glm::dot(p - middle_, across_); }
  double line(std::size_t k) const { return corners_[k + 1].place_m; }

  std::size_t find_stripe(const glm::dvec2& p) const {
    constexpr double on_line_m = 1e-6;
    std::size_t k = 0;
    for (; k + 2 < corners_.size(); ++k) {
      const double beyond = place_of(p) - line(k);
      if (std::abs(beyond) <= on_line_m) return 2 * k + 1;
      if (beyond < 0) break;
    }
    return 2 * k;
  }

  glm::dvec2 middle_, across_;
  const std::vector<RoofProfile::Corner>& corners_;
};

}  // namespace

RoofProfile make_gable(const BuildingSizes& sizes, double width_m) {
  return {{{-width_m / 2, sizes.eaves_m}, {0, sizes.top_m}, {width_m / 2, sizes.eaves_m}}};
}

RoofProfile make_gambrel(const BuildingSizes& sizes, double width_m) {
  const double share = std::numbers::sqrt2 / 2, place = share * width_m / 2;
  const double height = sizes.eaves_m + share * (sizes.top_m - sizes.eaves_m);
  return {{{-width_m / 2, sizes.eaves_m},
           {-place, height},
           {0, sizes.top_m},
           {place, height},
           {width_m / 2, sizes.eaves_m}}};
}

RoofProfile make_round(const BuildingSizes& sizes, double width_m) {
  constexpr int chords = 12;
  const double rise = sizes.top_m - sizes.eaves_m, half = width_m / 2;
  // The arc reaches `angle` to both sides of the top.
  const bool is_arc = rise < half;
  const double angle = is_arc ? 2 * std::atan(rise / half) : std::numbers::pi / 2;
  const double radius = half / std::sin(angle);
  RoofProfile profile;
  for (int i = 0; i <= chords; ++i) {
    const double t = angle * (2.0 * i / chords - 1);
    const double height = is_arc ? rise - radius * (1 - std::cos(t)) : rise * std::cos(t);
    profile.corners.push_back({radius * std::sin(t), sizes.eaves_m + std::max(height, 0.0)});
  }
  profile.corners.front().height_m = profile.corners.back().height_m = sizes.eaves_m;
  profile.corners[chords / 2] = {0, sizes.top_m};
  return profile;
}

RoofProfile make_saltbox(const BuildingSizes& sizes, double width_m) {
  return {{{-width_m / 2, sizes.eaves_m},
           {width_m / 6, sizes.top_m},
           {width_m / 2, (sizes.eaves_m + sizes.top_m) / 2}}};
}

RoofProfile make_butterfly(const BuildingSizes& sizes, double width_m) {
  return {{{-width_m / 2, sizes.top_m}, {0, sizes.eaves_m}, {width_m / 2, sizes.top_m}}};
}

RoofProfile make_double_saltbox(const BuildingSizes& sizes, double width_m) {
  return {{{-width_m / 2, sizes.eaves_m},
           {-width_m / 6, sizes.top_m},
           {width_m / 6, sizes.top_m},
           {width_m / 2, sizes.eaves_m}}};
}

namespace {

int count_steps(double width_m) {
  constexpr double most = 200;
  return static_cast<int>(std::clamp(std::round(width_m / row_step_m), 2.0, most));
}

// Steps of a rise to `peak` of their width and a fall behind that.
RoofProfile make_row(const BuildingSizes& sizes, double width_m, double peak) {
  const int count = count_steps(width_m);
  const double step = width_m / count;
  RoofProfile profile{{{-width_m / 2, sizes.eaves_m}}};
  for (int i = 0; i < count; ++i) {
    const double from = -width_m / 2 + i * step;
    profile.corners.push_back({from + peak * step, sizes.top_m});
    profile.corners.push_back({i + 1 == count ? width_m / 2 : from + step, sizes.eaves_m});
  }
  return profile;
}

}  // namespace

// The steep face leans by a hundredth, because places of a profile rise.
RoofProfile make_sawtooth(const BuildingSizes& sizes, double width_m) {
  return make_row(sizes, width_m, 0.99);
}

RoofProfile make_gabled_row(const BuildingSizes& sizes, double width_m) {
  return make_row(sizes, width_m, 0.5);
}

bool add_profile(Shell& shell, const glm::dvec2& middle, const glm::dvec2& along,
                 const RoofProfile& profile) {
  const Stripes stripes(middle, along, profile);
  const std::vector<Vertex> ring = stripes.cut(shell.outer());
  std::vector<city::Ring> faces;
  for (std::size_t k = 0; k + 1 < profile.corners.size(); ++k) {
    city::Ring& face = faces.emplace_back();
    for (const Vertex& v : ring)
      if (v.stripe + 1 >= 2 * k && v.stripe <= 2 * k + 1)
        face.emplace_back(v.at, stripes.height_of(v));
    if (face.size() < 3) return false;
  }
  const double foot = shell.sizes().foot_m;
  Ring2 floor;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vertex &a = ring[i], &b = ring[(i + 1) % ring.size()];
    floor.push_back(a.at);
    shell.add_wall({glm::dvec3(a.at, foot), glm::dvec3(b.at, foot),
                    glm::dvec3(b.at, stripes.height_of(b)),
                    glm::dvec3(a.at, stripes.height_of(a))});
  }
  shell.set_floor(std::move(floor));
  for (city::Ring& face : faces) shell.add_roof(std::move(face));
  return true;
}

}  // namespace nightcity::map_buildings
