// From the files of a city to prepared objects: each is read, placed in the city's frame, repaired,
// triangulated and passed on to every consumer.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tools/bake/city/city_consumer.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/city/object_feed.h"
#include "tools/bake/city/ready_object.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/city_report.h"

namespace nightcity::bake {

/// Memory does not grow with the city, but for what the consumers keep. Objects over 100 km from
/// the city's first file and objects that an earlier file has brought are left out and counted.
/// `heights`: as ReadySettings'. Throws Error as the reader of the files does.
CityReport read_prepared_objects(const CityInputs& inputs, CityFrames& frames,
                                 const GroundHeights* heights,
                                 std::span<CityConsumer* const> consumers,
                                 const ProgressSink& progress);

/// Returns how the files are to be read. Made once: it holds the list of all files.
city::ReadOptions to_read_options(const CityInputs& inputs);

/// Reads the input file of that number into `feed`. Throws Error as its reader does.
void read_into(ObjectFeed& feed, const CityInputs& inputs, std::size_t file,
               const city::ReadOptions& options);

/// Work on ready objects, as city::ObjectStage.
using ReadyStage = std::function<std::function<void()>(std::vector<ReadyObject>&&)>;
/// Reads the input file of that number, or the piece of it that `options` name, through `stage`.
city::ReadReport read_ready_objects(const CityInputs& inputs, const ReadySettings& settings,
                                    std::size_t file, const city::ReadOptions& options,
                                    const ReadyStage& stage);

/// Returns "reading 2 of 9: tile.gml", for the progress.
std::string describe_reading(const CityInputs& inputs, std::size_t file);

}  // namespace nightcity::bake
