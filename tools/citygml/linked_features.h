// Features that stand as members of their own, or in another file, and that an object links to in
// place of holding them: its parts, surfaces, installations, addresses.
#pragma once

#include <cstddef>
#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tools/citygml/member_splitter.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {

/// The links of one member, by the names that GeometryLibrary gives to what they lead to.
struct FeatureLinks {
  std::size_t member = 0;  // its number in the document
  /// The id of a member that may be a part of another's object; "" elsewhere.
  std::string lone_id{};
  std::vector<std::string> names{};

  bool empty() const { return lone_id.empty() && names.empty(); }
};

/// Returns the links of a member, and takes away those to what it holds itself: this is read where
/// it stands. `has_links`: false where the member's text has none.
FeatureLinks take_feature_links(pugi::xml_node member, bool has_links,
                                const GeometryLibrary& library);

/// Gives linked features to the objects that link to them, each to the first one.
class LinkedFeatures {
 public:
  /// `max_bytes`: of their text, over all.
  explicit LinkedFeatures(std::size_t max_bytes) : room_(max_bytes) {}

  /// Notes the links of a member; in the order of the document.
  void note(FeatureLinks&& links) { links_.push_back(std::move(links)); }
  bool empty() const { return links_.empty(); }
  std::vector<std::string> list_wanted() const;

  /// Takes the features out of a member whose ids are among `wanted`. `prefix`: of their names.
  void fetch_from(const pugi::xml_node& member, const std::unordered_set<std::string>& wanted,
                  const std::string& prefix, const GeometryLibrary& library);
  /// Decides who gets which feature; call when all have been fetched.
  void assign();

  /// Returns whether a member of this document belongs to an object that links to it.
  bool is_given_away(std::size_t member) const { return given_away_.contains(member); }
  /// Puts the features into the member in place of its links. Links to what stands elsewhere go
  /// away. Returns the ids of features from other files.
  std::vector<std::string> put_into(pugi::xml_node member, std::size_t number,
                                    const GeometryLibrary& library) const;
  /// Returns how many features had no room.
  std::size_t beyond_room() const { return beyond_room_; }

 private:
  struct Feature {
    std::string text;                // UTF-8; "" = it stands where it is
    std::vector<std::string> names;  // that it links to
    bool may_be_shared = false;      // an address
    bool is_elsewhere = false;       // in another file
  };
  void fetch(const pugi::xml_node& feature, bool stands_alone, const std::string& name,
             const GeometryLibrary& library);

  std::size_t room_;
  std::size_t beyond_room_ = 0;
  std::vector<FeatureLinks> links_;
  std::unordered_map<std::string, Feature> features_;    // by name
  std::unordered_map<std::string, std::size_t> owners_;  // members, by names of features
  std::unordered_set<std::size_t> given_away_;
};

}  // namespace nightcity::citygml
