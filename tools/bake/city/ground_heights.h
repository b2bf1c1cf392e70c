// Heights of elevation models, asked in the city's coordinates.
#pragma once

#include <glm/vec2.hpp>
#include <limits>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "tools/bake/city/ground_options.h"
#include "tools/georeference/frame.h"
#include "tools/terrain/elevation_model.h"
#include "tools/terrain/open_models.h"

namespace nightcity::bake {

class GroundHeights {
 public:
  /// Opens the models. `city` must outlive the object. Throws Error as open_elevation_models does,
  /// and where a model names a CRS and the city names none, or none and the city is a map, which
  /// has a frame of its own.
  GroundHeights(const GroundOptions& options, const georeference::CityFrame& city);

  std::size_t count() const { return models_.size(); }
  /// Returns the least distance of neighbouring heights of the models, m.
  double finest_m() const { return finest_; }

  /// Returns what is assumed about the models and may be wrong, each behind ", ".
  const std::string& assumptions() const { return assumptions_; }
  /// Returns which model names no CRS, and the remedy, for the message that none covers the city;
  /// "" where all name one.
  const std::string& unplaced() const { return unplaced_; }

  /// A kind of models: those of one resolution. Other kinds may count heights from elsewhere.
  struct Kind : terrain::ResolutionClass {
    double shift_m = 0;  // that is added to the heights
  };
  /// The kinds, the finest first.
  const std::vector<Kind>& kinds() const { return kinds_; }
  void move(std::size_t kind, double shift_m) { kinds_[kind].shift_m = shift_m; }

  /// Returns a height (m) for each place (E, N), with its kind's shift: that of the finest model
  /// that has one there, of about equally fine ones the first, between tiles that meet both
  /// (terrain::sample_models); NaN where none has. Places that lie together are read together. Safe
  /// to call from several threads, one of which works at a time. Throws Error when a model cannot
  /// be read.
  std::vector<double> at(std::span<const glm::dvec2> places) const { return read(places, kinds_); }
  /// Returns the height at a place, or where the models have none, one that they have near it:
  /// of the nearest of circles around it whose radii double, the first of 16 places that has one.
  /// NaN where none within 5 km has.
  double near(const glm::dvec2& place) const;
  /// The same as at() of one kind alone.
  std::vector<double> at(std::span<const glm::dvec2> places, std::size_t kind) const {
    return read(places, std::span(kinds_).subspan(kind, 1));
  }

 private:
  std::vector<double> read(std::span<const glm::dvec2> places, std::span<const Kind> kinds) const;

  const georeference::CityFrame& city_;
  std::vector<terrain::ElevationModel> models_;
  std::vector<Kind> kinds_;
  mutable std::mutex mutex_;  // of GDAL's datasets
  std::string assumptions_, unplaced_;
  double finest_ = std::numeric_limits<double>::infinity();
};

}  // namespace nightcity::bake
