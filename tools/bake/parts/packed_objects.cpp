#include "tools/bake/parts/packed_objects.h"

#include <algorithm>
#include <memory>

#include "tools/archive.h"

namespace nightcity::bake {
namespace {

using Windows = lights::WindowLayout::WindowBatch;

bool has_colour(const city::Polygon& polygon) {
  return polygon.diffuse_colour.has_value();
}

// Returns the object without the outlines that nobody will ask for. Colours stay with the number of
// their polygon.
city::CityObject strip(const city::CityObject& object) {
  city::CityObject stripped;
  stripped.id = object.id;
  stripped.type = object.type;
  stripped.class_name = object.class_name;
  stripped.function = object.function;
  stripped.usage = object.usage;
  stripped.building_class = object.building_class;
  stripped.address = object.address;
  stripped.year = object.year;
  stripped.measured_height_m = object.measured_height_m;
  stripped.storeys_above_ground = object.storeys_above_ground;
  stripped.storey_heights_m = object.storey_heights_m;
  stripped.lod = object.lod;
  stripped.of_map = object.of_map;
  stripped.joined_ids = object.joined_ids;
  stripped.plant = object.plant;
  stripped.points = object.points;
  stripped.lines = object.lines;
  if (std::any_of(object.polygons.begin(), object.polygons.end(), has_colour))
    for (const city::Polygon& polygon : object.polygons)
      stripped.polygons.emplace_back().diffuse_colour = polygon.diffuse_colour;
  return stripped;
}

// Field by field: the bytes between them would be any.
template <class Archive, class Tree>
void visit_tree(Archive& archive, Tree& tree) {
  archive(tree.id, tree.class_name, tree.function, tree.place, tree.foot_m, tree.height_m,
          tree.crown_m, tree.trunk_m, tree.habit.needles, tree.habit.evergreen, tree.is_shrub,
          tree.odd_sizes, tree.outlines);
}

template <class Archive, class Ready, class Prepared>
void visit(Archive& archive, Ready& ready, Prepared& prepared) {
  archive(ready.identity, ready.contents, ready.unusable, ready.beyond_heights, ready.report,
          ready.elsewhere, prepared.mesh.positions, prepared.mesh.triangles, prepared.lacks_heights,
          prepared.closed, prepared.use, prepared.pictures, prepared.pictured_polygons);
}

}  // namespace

std::string pack_objects(const std::vector<ReadyObject>& objects) {
  std::string bytes;
  Packer pack(bytes);
  pack(std::uint64_t{objects.size()});
  const std::string* last_id = nullptr;
  for (const ReadyObject& ready : objects) {
    const PreparedObject& prepared = *ready.prepared;
    const city::CityObject& object = prepared.object;
    visit(pack, ready, prepared);
    const bool may_continue = !last_id || *last_id == object.id;
    if (may_continue || object.type == city::ObjectType::road)
      pack(object);
    else
      pack(strip(object));
    last_id = &object.id;
    pack(prepared.no_tree, prepared.tree.has_value());
    if (prepared.tree) visit_tree(pack, *prepared.tree);
    pack(prepared.windows != nullptr);
    if (prepared.windows) pack(*prepared.windows);
  }
  return bytes;
}

std::vector<ReadyObject> unpack_objects(std::string_view bytes, const std::string& file) {
  Unpacker unpack(bytes, file);
  std::uint64_t count = 0;
  unpack(count);
  std::vector<ReadyObject> objects;
  for (; count > 0; --count) {
    ReadyObject& ready = objects.emplace_back();
    const auto prepared = std::make_shared<PreparedObject>();
    visit(unpack, ready, *prepared);
    unpack(prepared->object);
    bool is_tree = false, has_windows = false;
    unpack(prepared->no_tree, is_tree);
    if (is_tree) visit_tree(unpack, prepared->tree.emplace());
    unpack(has_windows);
    if (has_windows) {
      const auto windows = std::make_shared<Windows>();
      unpack(*windows);
      prepared->windows = windows;
    }
    ready.prepared = prepared;
  }
  return objects;
}

}  // namespace nightcity::bake
