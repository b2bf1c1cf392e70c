// Reports what covers the ground, from where, and what of it was left out.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/bake/report/scene_report.h"
#include "tools/ground_cover/cover.h"

namespace nightcity::bake {

struct CoverReport {
  std::size_t areas = 0;                        // of the map that lie on the ground
  std::size_t rounded_corners = 0;              // of carriageways
  std::size_t lowered_kerbs = 0;                // crossings where kerbs come down
  std::map<std::string, std::size_t> markings;  // by what they are
  std::map<std::string, std::size_t> left_out;  // by reason
  std::map<std::string, std::size_t> assumed;   // what no tag says
  /// Lengths within the ground: of tracks, by what they are and lie in; of parking lanes, by place
  /// and orientation; of what was left out, by reason.
  std::map<std::string, double> tracks_m, parking_m, left_out_m;

  /// Adds what lies on the ground, or on bridges.
  void add(const ground_cover::Cover& cover);
};

struct TreeReport {
  std::map<std::string, std::size_t> sources;   // trees, by where they are from
  std::map<std::string, std::size_t> left_out;  // by reason
  std::size_t assumed_sizes = 0;                // trees whose size nothing gives
  std::size_t odd_sizes = 0;                    // that the model gives and no tree has
  std::map<std::string, std::size_t> surfaces;  // plants of the model that are no trees, by reason
};
nlohmann::json to_json(const TreeReport& report);
std::string to_text(const TreeReport& report);

/// `tiles`: how much of each kind the scene shows.
nlohmann::json to_json(const CoverReport& report, const SceneTilesReport& tiles);
/// Returns "" where nothing covers the ground and nothing was left out.
std::string to_text(const CoverReport& report, const SceneTilesReport& tiles);

}  // namespace nightcity::bake
