// The constrained Delaunay triangulation in the plane that outlines are made with: exact predicates, what an
// edge crosses is resolved, data of one's own on faces. CGAL's headers are large: for .cpp files alone.
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

namespace nightcity {

using PlaneKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// `FaceInfo` is default-constructible: face->info().
template <class FaceInfo, class VertexBase = CGAL::Triangulation_vertex_base_2<PlaneKernel>>
using ConstrainedDelaunay = CGAL::Constrained_Delaunay_triangulation_2<
    PlaneKernel,
    CGAL::Triangulation_data_structure_2<
        VertexBase,
        CGAL::Constrained_triangulation_face_base_2<
            PlaneKernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, PlaneKernel>>>,
    CGAL::Exact_predicates_tag>;

}  // namespace nightcity
