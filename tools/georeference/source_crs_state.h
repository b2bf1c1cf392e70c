// The handles of PROJ that a SourceCrs holds, and what they say about the CRS.
#pragma once

#include <string>

#include "tools/georeference/proj_axes.h"
#include "tools/georeference/source_crs.h"

namespace nightcity::georeference {

struct SourceCrs::State {
  std::string refused_file;  // before the context, which writes it
  PjContextPtr context{proj_context_create()};
  PjPtr crs;    // horizontal part
  PjPtr bound;  // crs with the shift to WGS 84 that its definition states; null: it states none
  PjPtr to_degrees;  // crs to its own geographic CRS; null: it is one
  PjPtr operation;   // CRS 84 (longitude, latitude) to crs
  bool geographic = false;
  ProjAxes axes, degree_axes;
  double height_scale = 0;  // 0: no vertical part
  double semi_major = 6378137.0, inverse_flattening = 298.257223563;
  std::string name, identity, area_name;
  double west = -1000, south = -1000, east = -1000, north = -1000;  // -1000: not stated

  std::string explain_refusal() const {
    return "it names the file \"" + refused_file +
           "\", which only a recipe may do, by its keys named crs";
  }
  void read_vertical(const PJ* compound);
  bool read_axes(std::string& why);
  void read_identity(const std::string& definition);
  void read_area();
};

}  // namespace nightcity::georeference
