#include "tools/citygml/geometry_names.h"

#include <algorithm>
#include <array>

namespace nightcity::citygml {

bool is_polygon(std::string_view local) {
  return local == "Polygon" || local == "PolygonPatch" || local == "Triangle" ||
         local == "Rectangle";
}

bool is_container(std::string_view local) {
  static constexpr std::array names{std::string_view("surfaceMember"),
                                    std::string_view("MultiSurface"),
                                    std::string_view("CompositeSurface"),
                                    std::string_view("exterior"),
                                    std::string_view("Solid"),
                                    std::string_view("Shell"),
                                    std::string_view("trianglePatches"),
                                    std::string_view("TriangulatedSurface"),
                                    std::string_view("patches"),
                                    std::string_view("Surface"),
                                    std::string_view("surfaceMembers"),
                                    std::string_view("interior"),
                                    std::string_view("MultiSolid"),
                                    std::string_view("CompositeSolid"),
                                    std::string_view("solidMember"),
                                    std::string_view("solidMembers"),
                                    std::string_view("polygonPatches"),
                                    std::string_view("PolyhedralSurface"),
                                    std::string_view("Tin"),
                                    std::string_view("MultiGeometry"),
                                    std::string_view("geometryMember"),
                                    std::string_view("geometryMembers"),
                                    std::string_view("GeometricComplex"),
                                    std::string_view("element"),
                                    std::string_view("baseSurface")};
  return std::find(names.begin(), names.end(), local) != names.end();
}

bool is_geometry(std::string_view local) {
  return is_polygon(local) || is_container(local) || local == "OrientableSurface" ||
         local == "ImplicitGeometry";
}

}  // namespace nightcity::citygml
