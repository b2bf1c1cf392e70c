#include "tools/city/city_model.h"

namespace nightcity::city {

const char* name_of(ObjectType type) {
  switch (type) {
    case ObjectType::building:
      return "building";
    case ObjectType::bridge:
      return "bridge";
    case ObjectType::tunnel:
      return "tunnel";
    case ObjectType::relief:
      return "relief";
    case ObjectType::road:
      return "road";
    case ObjectType::railway:
      return "railway";
    case ObjectType::water:
      return "water";
    case ObjectType::vegetation:
      return "vegetation";
    case ObjectType::furniture:
      return "furniture";
    case ObjectType::land_use:
      return "land_use";
    case ObjectType::generic:
      return "generic";
    case ObjectType::other:
      break;
  }
  return "other";
}

const char* name_of(SurfaceType type) {
  switch (type) {
    case SurfaceType::unknown:
      break;
    case SurfaceType::wall:
      return "wall";
    case SurfaceType::roof:
      return "roof";
    case SurfaceType::ground:
      return "ground";
    case SurfaceType::closure:
      return "closure";
    case SurfaceType::outer_ceiling:
      return "outer_ceiling";
    case SurfaceType::outer_floor:
      return "outer_floor";
    case SurfaceType::window:
      return "window";
    case SurfaceType::door:
      return "door";
    case SurfaceType::traffic_area:
      return "traffic_area";
    case SurfaceType::auxiliary_traffic_area:
      return "auxiliary_traffic_area";
    case SurfaceType::terrain:
      return "terrain";
    case SurfaceType::water:
      return "water";
  }
  return "unknown";
}

}  // namespace nightcity::city
