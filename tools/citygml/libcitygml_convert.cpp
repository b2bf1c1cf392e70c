#include "tools/citygml/libcitygml_convert.h"

#include <citygml/address.h>
#include <citygml/geometry.h>
#include <citygml/implictgeometry.h>
#include <citygml/linearring.h>
#include <citygml/material.h>
#include <citygml/polygon.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "tools/city/attributes.h"
#include "tools/city/plant_attributes.h"
#include "tools/citygml/libcitygml_text.h"

namespace nightcity::citygml {
namespace {

using Type = ::citygml::CityObject::CityObjectsType;

city::ObjectType object_type(Type type) {
  switch (type) {
    case Type::COT_Building:
    case Type::COT_BuildingPart:
      return city::ObjectType::building;
    case Type::COT_Bridge:
    case Type::COT_BridgePart:
      return city::ObjectType::bridge;
    case Type::COT_Tunnel:
      return city::ObjectType::tunnel;
    case Type::COT_ReliefFeature:
    case Type::COT_ReliefComponent:
    case Type::COT_TINRelief:
    case Type::COT_MassPointRelief:
    case Type::COT_BreaklineRelief:
    case Type::COT_RasterRelief:
      return city::ObjectType::relief;
    case Type::COT_Track:
    case Type::COT_Road:
    case Type::COT_Square:
    case Type::COT_TransportationObject:
      return city::ObjectType::road;
    case Type::COT_Railway:
      return city::ObjectType::railway;
    case Type::COT_WaterBody:
      return city::ObjectType::water;
    case Type::COT_PlantCover:
    case Type::COT_SolitaryVegetationObject:
      return city::ObjectType::vegetation;
    case Type::COT_CityFurniture:
      return city::ObjectType::furniture;
    case Type::COT_LandUse:
      return city::ObjectType::land_use;
    case Type::COT_GenericCityObject:
      return city::ObjectType::generic;
    default:
      return city::ObjectType::other;
  }
}

city::SurfaceType surface_type(Type type, city::SurfaceType inherited) {
  switch (type) {
    case Type::COT_WallSurface:
      return city::SurfaceType::wall;
    case Type::COT_RoofSurface:
      return city::SurfaceType::roof;
    case Type::COT_GroundSurface:
      return city::SurfaceType::ground;
    case Type::COT_ClosureSurface:
      return city::SurfaceType::closure;
    case Type::COT_OuterCeilingSurface:
      return city::SurfaceType::outer_ceiling;
    case Type::COT_OuterFloorSurface:
      return city::SurfaceType::outer_floor;
    case Type::COT_Window:
      return city::SurfaceType::window;
    case Type::COT_Door:
      return city::SurfaceType::door;
    case Type::COT_TINRelief:
      return city::SurfaceType::terrain;
    case Type::COT_WaterBody:
      return city::SurfaceType::water;
    default:
      return inherited;
  }
}

bool is_part(Type type) {
  return type == Type::COT_BuildingPart || type == Type::COT_BridgePart;
}

bool is_detail(Type type) {
  return type == Type::COT_BuildingInstallation || type == Type::COT_BridgeInstallation ||
         type == Type::COT_BridgeConstructionElement;
}

// Neither lights nor cameras get in.
bool is_interior(Type type) {
  return type == Type::COT_Room || type == Type::COT_IntBuildingInstallation ||
         type == Type::COT_BuildingFurniture || type == Type::COT_FloorSurface ||
         type == Type::COT_InteriorWallSurface || type == Type::COT_CeilingSurface;
}

struct Converter {
  const std::vector<std::string>& themes;
  LibcitygmlObject out;
  struct Seen {
    const ::citygml::Polygon* polygon;
    int lod;
    bool operator==(const Seen&) const = default;
  };
  struct SeenHash {
    std::size_t operator()(const Seen& s) const {
      return std::hash<const void*>()(s.polygon) ^ static_cast<std::size_t>(s.lod + 1);
    }
  };
  std::unordered_map<Seen, std::size_t, SeenHash> taken;  // a solid and its walls share polygons

  struct Context {
    std::uint32_t space;
    city::SurfaceType surface;
    bool interior;
    const double* matrix = nullptr;  // row-major 4 x 4 of an implicit geometry
    glm::dvec3 reference{0};
  };

  void read_attributes(const ::citygml::CityObject& object) {
    for (const auto& [key, value] : object.getAttributes()) {
      const std::string name = key.substr(key.rfind(':') + 1);  // from 0 where there is none
      const std::string text = restore_entities(value.asString());
      city::CityObject& taker = out.raw.object;
      if (!taker.plant || !city::set_plant_attribute(*taker.plant, name, text))
        city::set_attribute(taker, name, text);
    }
    if (const ::citygml::Address* a = object.address(); a && out.raw.object.address.empty()) {
      std::string text;
      for (const std::string* part : {&a->thoroughfareName(), &a->thoroughfareNumber(),
                                      &a->postalCode(), &a->locality(), &a->country()}) {
        if (part->empty()) continue;
        if (!text.empty()) text += ' ';
        text += restore_entities(*part);
      }
      out.raw.object.address = text;
    }
  }

  static city::Ring ring_of(const ::citygml::LinearRing& source, const Context& context) {
    city::Ring ring;
    for (const TVec3d& v : source.getVertices()) {
      glm::dvec3 p{v.x, v.y, v.z};
      if (const double* m = context.matrix)
        p = glm::dvec3{m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3],
                       m[4] * v.x + m[5] * v.y + m[6] * v.z + m[7],
                       m[8] * v.x + m[9] * v.y + m[10] * v.z + m[11]} +
            context.reference;
      if (ring.empty() || ring.back() != p) ring.push_back(p);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    return ring;
  }

  void take(const ::citygml::Polygon& polygon, int lod, const Context& context) {
    const auto [at, fresh] = taken.emplace(Seen{&polygon, lod}, out.raw.polygons.size());
    if (!fresh && !context.matrix) {
      if (at->second < out.raw.polygons.size()) {
        city::SurfaceType& surface = out.raw.polygons[at->second].surface;
        if (surface == city::SurfaceType::unknown) surface = context.surface;
      }
      return;
    }
    if (fresh) ++out.polygons_seen;
    if (context.interior) {
      at->second = static_cast<std::size_t>(-1);
      ++out.skipped["polygon: inside a building"];
      return;
    }
    city::Polygon raw;
    raw.id = polygon.getId();
    raw.surface = context.surface;
    if (const auto exterior = polygon.exteriorRing()) raw.exterior = ring_of(*exterior, context);
    for (const auto& interior : polygon.interiorRings())
      if (interior) raw.interiors.push_back(ring_of(*interior, context));
    if (polygon.negNormal()) {
      std::reverse(raw.exterior.begin(), raw.exterior.end());
      for (city::Ring& ring : raw.interiors) std::reverse(ring.begin(), ring.end());
    }
    for (const std::string& theme : themes) {
      const auto material = polygon.getMaterialFor(theme);
      if (!material) continue;
      const TVec3f c = material->getDiffuse();
      raw.diffuse_colour = glm::vec3{c.x, c.y, c.z};
      break;
    }
    if (raw.exterior.size() < 3) {
      at->second = static_cast<std::size_t>(-1);
      ++out.skipped["polygon: ring of fewer than three vertices"];
      return;
    }
    out.raw.polygons.add(std::move(raw), {lod, context.space});
  }

  void walk_geometry(const ::citygml::Geometry& geometry, int lod, const Context& context) {
    for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i)
      if (const auto polygon = geometry.getPolygon(i)) take(*polygon, lod, context);
    for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i)
      walk_geometry(geometry.getGeometry(i), lod, context);
    if (geometry.getLineStringCount() > 0)
      out.skipped["LineString"] += geometry.getLineStringCount();
  }

  void walk(const ::citygml::CityObject& object, Context context) {
    const Type type = object.getType();
    context.surface = surface_type(type, context.surface);
    context.interior = context.interior || is_interior(type);
    if (is_part(type) || is_detail(type)) {
      context.space = static_cast<std::uint32_t>(out.raw.spaces.size());
      out.raw.spaces.push_back({is_detail(type)});
      context.surface = city::SurfaceType::unknown;
    }
    for (unsigned i = 0; i < object.getGeometriesCount(); ++i) {
      const ::citygml::Geometry& geometry = object.getGeometry(i);
      walk_geometry(geometry, static_cast<int>(geometry.getLOD()), context);
    }
    for (unsigned i = 0; i < object.getImplicitGeometryCount(); ++i) {
      const ::citygml::ImplicitGeometry& implicit = object.getImplicitGeometry(i);
      Context placed = context;
      placed.matrix = implicit.getTransformMatrix().getMatrix();
      const TVec3d r = implicit.getReferencePoint();
      placed.reference = {r.x, r.y, r.z};
      if (const double* m = placed.matrix; m && out.raw.object.plant)
        out.raw.object.points.push_back(glm::dvec3(m[3], m[7], m[11]) + placed.reference);
      for (unsigned g = 0; g < implicit.getGeometriesCount(); ++g)
        walk_geometry(implicit.getGeometry(g), static_cast<int>(implicit.getGeometry(g).getLOD()),
                      placed);
    }
    for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i)
      walk(object.getChildCityObject(i), context);
  }
};

}  // namespace

LibcitygmlObject convert(const ::citygml::CityObject& root,
                         const std::vector<std::string>& themes) {
  Converter converter{themes, {}, {}};
  city::CityObject& object = converter.out.raw.object;
  object.id = root.getId();
  object.type = object_type(root.getType());
  object.class_name = root.getTypeAsString();
  if (object.type == city::ObjectType::vegetation) object.plant.emplace();
  converter.read_attributes(root);
  converter.walk(root, {0,
                        object.type == city::ObjectType::relief ? city::SurfaceType::terrain
                                                                : city::SurfaceType::unknown,
                        false});
  return std::move(converter.out);
}

}  // namespace nightcity::citygml
