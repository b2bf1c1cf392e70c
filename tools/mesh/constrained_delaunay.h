// Constrained Delaunay triangulations in the plane, with the caller's data on faces and vertices.
// CGAL's headers are large: for .cpp files alone.
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <glm/vec2.hpp>

namespace nightcity::mesh {

using PlaneKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// `FaceInfo` is default-constructible: face->info(). Where constraints cross, `Tag` decides what
/// happens.
template <class FaceInfo, class VertexBase = CGAL::Triangulation_vertex_base_2<PlaneKernel>,
          class Kernel = PlaneKernel, class Tag = CGAL::Exact_predicates_tag>
using ConstrainedDelaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<
        VertexBase, CGAL::Constrained_triangulation_face_base_2<
                        Kernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>>,
    Tag>;

/// The two ways to triangulate outlines and to ask which of them run along an edge
/// (CGAL::Constrained_triangulation_plus_2). A crossing that is rounded to doubles lies on neither
/// of its lines: the record of constraints then misses edges, and asking for one reads invalid
/// memory. So nothing is ever rounded. With UncrossedOutlines, which is fast and enough for nearly
/// all rings, insert_constraint() throws Intersection_of_constraints_exception at the first
/// crossing; CrossedOutlines computes crossings exactly.
struct UncrossedOutlines {
  using Kernel = PlaneKernel;
  using Tag = CGAL::No_constraint_intersection_requiring_constructions_tag;
};
struct CrossedOutlines {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  using Tag = CGAL::Exact_intersections_tag;
};

/// Returns the doubles nearest to a point's coordinates.
inline glm::dvec2 to_plan(const PlaneKernel::Point_2& p) {
  return {p.x(), p.y()};
}
inline glm::dvec2 to_plan(const CrossedOutlines::Kernel::Point_2& p) {
  return {CGAL::to_double(CGAL::exact(p.x())), CGAL::to_double(CGAL::exact(p.y()))};
}

}  // namespace nightcity::mesh
