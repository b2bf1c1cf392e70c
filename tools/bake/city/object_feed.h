// Passes ready objects on to the consumers of a city, in file order.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "tools/bake/city/city_consumer.h"
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
        progress_(progress) {}

  /// Objects that have been through the consumers' work for many threads.
  struct Batch {
    struct Item {
      ReadyObject ready;
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
  /// or the same file with the same outlines, is left out and counted.
  void take(Batch&& batch);

  /// To be called once, as the last function.
  CityReport finish();

  const ReadySettings& settings() const { return settings_; }

 private:
  Batch::Item prepare(ReadyObject&& ready) const;
  void learn_crs(city::CityObject&& object, Batch::Item& item);
  void take(Batch::Item&& item);
  /// Returns why an object repeats an earlier one, as it is counted; null: it is new.
  const char* find_repeat(const ReadyObject& ready);

  const CityInputs& inputs_;
  CityFrames& frames_;
  ReadySettings settings_;
  std::span<CityConsumer* const> consumers_;
  const ProgressSink& progress_;
  CityReport report_;
  std::size_t file_ = 0, taken_ = 0;
  std::string stage_, last_id_;
  std::map<std::string, std::size_t> elsewhere_;  // objects of this file, by the CRS they name
  struct Seen {
    std::size_t file;  // that brought it
    std::uint64_t contents;
  };
  std::unordered_map<std::uint64_t, Seen> seen_;  // by identity
};

}  // namespace nightcity::bake
