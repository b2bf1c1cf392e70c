// Finds the objects that the files of a city hold more than once: in files of neighbouring areas,
// in copies, and in deliveries of several levels of detail.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity::bake {

/// The marks that tell an object from others, and one of its versions from another.
struct ObjectVersion {
  std::uint64_t id = 0;        // of its id
  std::uint64_t identity = 0;  // of its id and first vertex
  std::uint64_t contents = 0;  // of all of its outlines
  std::uint32_t file = 0;      // of the city, that holds it
  std::int8_t lod = -1;        // -1: the file does not say
  city::ObjectType type = city::ObjectType::other;
  /// The least and greatest easting and northing, from the city's reference point; none where it
  /// has no surface.
  std::array<float, 4> box{1, 1, 0, 0};
};

/// The versions of objects of which a better level of detail came later in the files, and the parts
/// of objects that came later.
struct OutdatedVersions {
  std::unordered_map<std::uint64_t, const char*> reasons;  // as they are counted, by key
  int rounds = 0;                                          // of reading that found them
};

/// Thrown when a city has been read in which a better level of detail followed one that was used
/// already: what has been made of the city has to be made anew without the outdated versions.
class BetterLevelsFollow : public std::exception {
 public:
  explicit BetterLevelsFollow(std::shared_ptr<const OutdatedVersions> outdated)
      : outdated_(std::move(outdated)) {}
  const char* what() const noexcept override { return "better levels of detail follow"; }
  const std::shared_ptr<const OutdatedVersions>& outdated() const { return outdated_; }

 private:
  std::shared_ptr<const OutdatedVersions> outdated_;
};

class ObjectVersions {
 public:
  /// `known`: of an earlier round; null: this is the first. `max_lod`: ReadOptions::max_lod.
  ObjectVersions(std::shared_ptr<const OutdatedVersions> known, int max_lod)
      : known_(std::move(known)), max_lod_(max_lod) {}

  /// Returns why the next object in the order of the files is to be left out, as it is counted;
  /// null: it is new, or better than one that was taken. `joined`: CityObject::joined_ids.
  const char* take(const ObjectVersion& version, const std::vector<std::string>& joined = {});

  /// Throws BetterLevelsFollow where take() has found objects better than those taken before.
  void finish() const;

 private:
  const ObjectVersion* find_same(const ObjectVersion& version) const;
  void keep(const ObjectVersion& version);
  void forget(ObjectVersion version);
  void join(const ObjectVersion& whole, const std::vector<std::string>& ids);

  std::shared_ptr<const OutdatedVersions> known_;
  int max_lod_;
  std::unordered_map<std::uint64_t, ObjectVersion> kept_;             // by identity
  std::unordered_multimap<std::uint64_t, std::uint64_t> identities_;  // by id
  std::unordered_map<std::uint64_t, const char*> outdated_;
  std::unordered_map<std::uint64_t, ObjectVersion> joined_;  // that hold a part, by its id
};

/// Does `work` with `inputs` (CityInputs), and anew as often as it finds better levels of detail
/// behind those that it has used.
template <class Inputs, class Work>
auto use_best_levels(Inputs& inputs, const Work& work) {
  for (;;) {
    try {
      return work();
    } catch (const BetterLevelsFollow& found) {
      inputs.outdated = found.outdated();
    }
  }
}

}  // namespace nightcity::bake
