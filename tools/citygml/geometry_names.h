// The element names of GML's surfaces.
#pragma once

#include <string_view>

namespace nightcity::citygml {

/// All take the name without prefix.
bool is_polygon(std::string_view local);
/// Elements that only hold the geometry they are made of.
bool is_container(std::string_view local);
/// Polygons, containers, OrientableSurface and ImplicitGeometry.
bool is_geometry(std::string_view local);

}  // namespace nightcity::citygml
