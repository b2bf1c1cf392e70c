// Passes ready objects on to the consumers of a city, in file order.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "tools/bake/city/city_consumer.h"
#include "tools/bake/city/object_versions.h"
#include "tools/bake/city/ready_object.h"
#include "tools/bake/progress.h"
#include "tools/bake/report/city_report.h"

namespace nightcity::bake {

class ObjectFeed {
 public:
  /// `frames` learns the names of other CRSs, in file order.
  ObjectFeed(const CityInputs& inputs, CityFrames& frames, const GroundHeights* heights,
             std::span<CityConsumer* const> consumers, const ProgressSink& progress)
      : inputs_(inputs),
        frames_(frames),
        settings_(to_ready_settings(inputs, frames, heights)),
        consumers_(consumers),
        progress_(progress),
        versions_(inputs.outdated, inputs.read.max_lod) {}

  /// Objects that have been through the consumers' work for many threads.
  struct Batch {
    struct Item {
      ReadyObject ready;
      ObjectVersion version;
      std::vector<CityConsumer::Turn> turns;
    };
    std::vector<Item> items;
  };
  /// Has the consumers prepare the objects. May be called from many threads.
  Batch prepare(std::vector<ReadyObject>&& objects) const;

  /// Says that the objects that follow come from the input file of that number.
  void begin_file(std::size_t file);
  /// Says that they do no more. `read`: the report of reading it.
  void end_file(const city::ReadReport& read);
  /// Gives the objects their turns, in file order. An object that an earlier file has brought,
  /// or the same file with the same outlines, is left out and counted, as is one that is there in a
  /// better level of detail.
  void take(Batch&& batch);

  /// To be called once, as the last function. Throws BetterLevelsFollow.
  CityReport finish();

  const ReadySettings& settings() const { return settings_; }

 private:
  Batch::Item prepare(ReadyObject&& ready) const;
  const char* find_repeat(const Batch::Item& item);
  void learn_crs(city::CityObject&& object, Batch::Item& item);
  void take(Batch::Item&& item);

  const CityInputs& inputs_;
  CityFrames& frames_;
  ReadySettings settings_;
  std::span<CityConsumer* const> consumers_;
  const ProgressSink& progress_;
  CityReport report_;
  std::size_t file_ = 0, taken_ = 0;
  std::string stage_, last_id_;
  std::string repeated_id_;                       // of the object before, where it was a repeat
  const char* repeated_ = nullptr;                // and why
  std::map<std::string, std::size_t> elsewhere_;  // objects of this file, by the CRS they name
  ObjectVersions versions_;
};

}  // namespace nightcity::bake
