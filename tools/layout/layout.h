// Street lamps where the map has streets and no lamps: laid out as towns lay them out, by width, height and
// the light that the street's class asks for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/layout/road_illuminance.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::layout {

struct LayoutOptions {
  enum class Mode {
    automatic,  // where no mapped lamp stands within 1.5 spacings on the same street
    never,
    always  // everywhere; mapped lamps are not used
  };
  Mode mode = Mode::automatic;
  std::map<std::string, std::string>
      class_of;  // highway value: EN 13201-2 class ("M4", "P3"), instead of
                 // the table's; checked by whoever reads it
};

/// One stretch between junctions. Illuminances are those of the scene as it stands: new luminaires, every
/// lamp within five mounting heights, mapped ones too, nothing in the way.
struct StreetReport {
  std::string highway, name, wanted;  // wanted: class
  std::vector<std::int64_t> ways;
  Arrangement arrangement = Arrangement::single;
  double length_m = 0, width_m = 0;  // of the part in the model
  double spacing_m = 0, flux_lm = 0, mounting_m = 0;
  std::size_t lamps = 0;
  double wanted_lx = 0;
  FieldSummary field;
};

/// All streets of one class of road.
struct RoadClassReport {
  std::string wanted;
  double wanted_lx = 0;
  double length_m = 0;
  std::size_t streets = 0, lamps = 0;
  double average_lx = 0;              // over the area of all of them
  double min_lx = 0, uniformity = 0;  // medians of the streets at least one spacing long
  double in_class = 0;  // share of the length whose maintained average is within its class
};

struct LayoutReport {
  std::vector<StreetReport> streets;
  std::map<std::string, RoadClassReport> classes;  // by highway
  std::map<std::string, std::size_t> unlit_ways;   // in the model and not to be lit, by reason
  std::map<std::string, std::size_t> left_out;     // places where the rule wanted a lamp, by reason
  std::map<std::string, std::size_t> notes;        // what was moved
  std::map<std::string, std::size_t> arrangements;  // lamps by arrangement
  std::size_t lamps = 0;
};

/// Appends lamps to `set`, which holds the mapped ones. Each is named after its way and its place along it,
/// so that it stays the same whatever else is in the map; its flux is by ValueSource::standard, the rest by
/// ValueSource::rule. Mode::never adds nothing.
LayoutReport lay_out_lamps(const OsmData& osm, const LonLatToFrame& to_frame,
                           const HeightAt& height_at, const InsideBuilding& inside,
                           const LampOptions& lamps, const LayoutOptions& options, LampSet& set);

}  // namespace nightcity::layout
