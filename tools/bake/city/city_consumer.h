// A consumer gets the objects of a city while the city is read: the ground, the scene's tiles,
// windows, roads.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "tools/bake/city/surface_pictures.h"
#include "tools/city/city_model.h"
#include "tools/lights/building_use.h"
#include "tools/lights/windows.h"
#include "tools/mesh/triangle_mesh.h"
#include "tools/trees/model_tree.h"

namespace nightcity::bake {

/// One object of the city, ready for use. Coordinates are E, N, H of the city's frame, in metres;
/// shells are repaired, unknown surfaces classified.
struct PreparedObject {
  city::CityObject object;
  mesh::TriangleMesh mesh;     // without triangles where the object has points or lines alone
  bool lacks_heights = false;  // published at height 0: the ground decides how high it lies
  bool closed = false;         // a building whose surfaces bound a volume without a gap
  /// The tree that a plant is, or why it is none.
  std::optional<trees::ModelTree> tree;
  trees::NoTree no_tree = trees::NoTree::no_plant;
  /// The use of the building, where it has been looked for while a part of the city was read.
  std::optional<lights::BuildingUse> use;
  /// Walls and windows, where they have been looked for while a part of the city was read.
  std::shared_ptr<const lights::WindowLayout::WindowBatch> windows;
  SurfacePictures pictures;
  std::uint64_t pictured_polygons = 0;  // that have a picture, also where `pictures` has none
};

class CityConsumer {
 public:
  virtual ~CityConsumer() = default;

  /// The work that is left for when the object's turn has come. `continues`: the object is a
  /// further piece of the one before it (a large object comes in pieces under one id).
  using Turn = std::function<void(bool continues)>;

  /// Called on many threads at once, so it must not change the consumer; it does what needs no
  /// other object. The function that it returns is called in the order of the files, one at a time,
  /// unless the object turns out to be a duplicate. It may be empty.
  virtual Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) = 0;
};

}  // namespace nightcity::bake
