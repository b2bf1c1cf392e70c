// A thing of the map in the city's frame, with what its tags say about its kind and hours.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/light_file.h"
#include "tools/lights/night_schedule.h"
#include "tools/map_lights/map_light_options.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::map_lights {

/// Returns the kind of light that the tags speak of; none where they speak of none.
std::optional<MapLightKind> find_kind(const osm::OsmTags& tags);

/// Returns whether the tags are of a plaque, a paving stone or a painting, which have tags of
/// history and art, and no walls.
bool is_flat(const osm::OsmTags& tags);
/// Returns whether they are of a pitch or a running track, and not of a ground that holds some.
bool is_pitch(const osm::OsmTags& tags);
/// Returns whether a place of sports is lit inside, below its roof. A stadium is open where people
/// play, building or not.
bool is_roofed(const osm::OsmTags& tags);

/// Returns the half of the Earth that a thing stands on, which decides the season of its hours.
lights::Half half_of(const osm::OsmShiningThing& thing);

struct Hours {
  lights::NightSchedule night;
  ValueSource source = ValueSource::rule;
};
/// Returns when a thing shines: by its tags `lit` or `floodlit`, a petrol station by its
/// `opening_hours`, otherwise by the options, otherwise by the defaults. Counts in `notes` what it
/// cannot read.
Hours find_hours(MapLightKind kind, const osm::OsmShiningThing& thing,
                 const MapLightOptions& options, std::map<std::string, std::size_t>& notes);

/// Returns the places of a thing's nodes in the frame; of a closed way without the repeated one.
/// Empty where one has no place there.
std::vector<glm::dvec2> find_outline(const osm::OsmShiningThing& thing,
                                     const place::LonLatToFrame& to_frame);
/// Returns whether the way encloses an area.
bool is_closed(const std::vector<glm::dvec2>& lon_lat);

}  // namespace nightcity::map_lights
