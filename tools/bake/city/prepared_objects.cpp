#include "tools/bake/city/prepared_objects.h"

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "tools/inputs/read_city.h"

namespace nightcity::bake {

std::string describe_reading(const CityInputs& inputs, std::size_t file) {
  return "reading " + std::to_string(file + 1) + " of " + std::to_string(inputs.files.size()) +
         ": " + inputs.files[file].filename().string();
}

city::ReadOptions to_read_options(const CityInputs& inputs) {
  city::ReadOptions options = inputs.read;
  if (inputs.files.size() > 1) {
    const auto neighbours = std::make_shared<std::set<std::filesystem::path>>();
    for (const auto& each : inputs.files) neighbours->insert(each.lexically_normal());
    options.neighbours = neighbours;
  }
  return options;
}

city::ReadReport read_ready_objects(const CityInputs& inputs, const ReadySettings& settings,
                                    std::size_t file, const city::ReadOptions& given,
                                    const ReadyStage& stage) {
  city::ReadOptions options = given;
  options.srs_name = settings.frames.srs_name_of(file);
  options.height_unit_m = settings.frames.height_unit_of(file);
  return inputs::read_city_staged(
      inputs.files[file], options,
      [&](std::vector<city::CityObject>&& read) -> std::function<void()> {
        std::vector<ReadyObject> ready;
        ready.reserve(read.size());
        for (city::CityObject& object : read)
          ready.push_back(make_ready(std::move(object), file, settings));
        return stage(std::move(ready));
      });
}

void read_into(ObjectFeed& feed, const CityInputs& inputs, std::size_t file,
               const city::ReadOptions& options) {
  feed.begin_file(file);
  feed.end_file(read_ready_objects(inputs, feed.settings(), file, options,
                                   [&](std::vector<ReadyObject>&& ready) -> std::function<void()> {
                                     // std::function wants to copy what it holds.
                                     const auto batch = std::make_shared<ObjectFeed::Batch>(
                                         feed.prepare(std::move(ready)));
                                     return [&feed, batch] { feed.take(std::move(*batch)); };
                                   }));
}

CityReport read_prepared_objects(const CityInputs& inputs, CityFrames& frames,
                                 const GroundHeights* heights,
                                 std::span<CityConsumer* const> consumers,
                                 const ProgressSink& progress) {
  ObjectFeed feed(inputs, frames, heights, consumers, progress);
  const city::ReadOptions options = to_read_options(inputs);
  for (std::size_t i = 0; i < inputs.files.size(); ++i) read_into(feed, inputs, i, options);
  return feed.finish();
}

}  // namespace nightcity::bake
