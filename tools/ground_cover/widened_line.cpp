#include "tools/ground_cover/widened_line.h"

#include <geos_c.h>

#include <cmath>
#include <utility>

#include "formats/finite.h"

namespace nightcity::ground_cover {
namespace {

// A round end is a quarter circle of this many pieces on each side. Bends are mitred up to a
// corner of 60 degrees, beyond which they are cut off.
constexpr int pieces_a_quarter = 3;
constexpr double mitre_limit = 2;

// GEOS reports through the return values too; its own lines belong on no one's screen.
void ignore(const char*, void*) {}

}  // namespace

struct Widener::State {
  GEOSContextHandle_t geos = GEOS_init_r();
  GEOSBufferParams* both = make(0, GEOSBUF_CAP_ROUND);
  GEOSBufferParams* both_flat = make(0, GEOSBUF_CAP_FLAT);
  GEOSBufferParams* single = make(1, GEOSBUF_CAP_FLAT);

  State() {
    GEOSContext_setNoticeMessageHandler_r(geos, ignore, nullptr);
    GEOSContext_setErrorMessageHandler_r(geos, ignore, nullptr);
  }
  ~State() {
    GEOSBufferParams_destroy_r(geos, both);
    GEOSBufferParams_destroy_r(geos, both_flat);
    GEOSBufferParams_destroy_r(geos, single);
    GEOS_finish_r(geos);
  }

  GEOSBufferParams* make(int single_sided, int ends) const {
    GEOSBufferParams* params = GEOSBufferParams_create_r(geos);
    GEOSBufferParams_setQuadrantSegments_r(geos, params, pieces_a_quarter);
    GEOSBufferParams_setEndCapStyle_r(geos, params, ends);
    GEOSBufferParams_setJoinStyle_r(geos, params, GEOSBUF_JOIN_MITRE);
    GEOSBufferParams_setMitreLimit_r(geos, params, mitre_limit);
    GEOSBufferParams_setSingleSided_r(geos, params, single_sided);
    return params;
  }

  void add_ring(const GEOSGeometry* ring, std::vector<Ring>& rings) const {
    const GEOSCoordSequence* points = GEOSGeom_getCoordSeq_r(geos, ring);
    unsigned size = 0;
    if (!points || !GEOSCoordSeq_getSize_r(geos, points, &size) || size < 4) return;
    Ring out(size);
    for (unsigned i = 0; i < size; ++i) GEOSCoordSeq_getXY_r(geos, points, i, &out[i].x, &out[i].y);
    out.pop_back();  // the first point again
    rings.push_back(std::move(out));
  }

  void add_rings(const GEOSGeometry* area, std::vector<Ring>& rings) const {
    if (GEOSGeomTypeId_r(geos, area) != GEOS_POLYGON) {
      const int parts = GEOSGetNumGeometries_r(geos, area);
      for (int i = 0; i < parts; ++i)
        if (const GEOSGeometry* part = GEOSGetGeometryN_r(geos, area, i); part != area)
          add_rings(part, rings);
      return;
    }
    if (const GEOSGeometry* shell = GEOSGetExteriorRing_r(geos, area)) add_ring(shell, rings);
    const int holes = GEOSGetNumInteriorRings_r(geos, area);
    for (int i = 0; i < holes; ++i) add_ring(GEOSGetInteriorRingN_r(geos, area, i), rings);
  }
};

Widener::Widener() : state_(std::make_unique<State>()) {}
Widener::~Widener() = default;

std::vector<Ring> Widener::widen(std::span<const glm::dvec2> line, double distance_m, Side side,
                                 Ends ends) {
  std::vector<double> coordinates;
  for (const glm::dvec2& p : line) {
    const std::size_t n = coordinates.size();
    if (!finite(p) || (n > 0 && coordinates[n - 2] == p.x && coordinates[n - 1] == p.y)) continue;
    coordinates.push_back(p.x);
    coordinates.push_back(p.y);
  }
  // GEOS does not survive a distance that is no number.
  if (coordinates.size() < 4 || !(distance_m > 0) || !std::isfinite(distance_m)) return {};
  const GEOSContextHandle_t geos = state_->geos;
  GEOSGeometry* input = GEOSGeom_createLineString_r(
      geos, GEOSCoordSeq_copyFromBuffer_r(geos, coordinates.data(),
                                          static_cast<unsigned>(coordinates.size() / 2), 0, 0));
  if (!input) return {};
  // GEOS: one side is the left, or the right at a negative distance.
  const GEOSBufferParams* params = side != Side::both    ? state_->single
                                   : ends == Ends::round ? state_->both
                                                         : state_->both_flat;
  GEOSGeometry* area =
      GEOSBufferWithParams_r(geos, input, params, side == Side::right ? -distance_m : distance_m);
  std::vector<Ring> rings;
  if (area) state_->add_rings(area, rings);
  if (area) GEOSGeom_destroy_r(geos, area);
  GEOSGeom_destroy_r(geos, input);
  return rings;
}

}  // namespace nightcity::ground_cover
