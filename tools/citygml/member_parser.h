// Turns one member's features into city objects.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/city/merge_parts.h"
#include "tools/city/skip_counter.h"
#include "tools/citygml/citygml_schema.h"
#include "tools/citygml/geometry_walk.h"

namespace nightcity::citygml {

class MemberParser {
 public:
  /// `member`: a cityObjectMember, featureMember or member, or the object itself. `line`: its first
  /// one in the document. `file_materials`: those of the document's own appearances.
  MemberParser(const pugi::xml_node& member, std::size_t line, const GeometryLibrary& library,
               const Materials& file_materials);

  /// Looks at the names of CRSs in the member from now on; `scope` must outlive the parser.
  void set_srs_scope(SrsScope* scope) { geometry_.set_srs_scope(scope); }
  /// Sets the name that geometry has which names none.
  void set_srs_name(SrsName name) { srs_name_ = std::move(name); }

  /// Returns every city object of the member. What is not used goes to skipped().
  std::vector<city::RawObject> parse();

  const city::SkipCounter& skipped() const { return skipped_; }
  const std::vector<std::string>& unresolved() const { return geometry_.unresolved(); }

 private:
  void read_top(const pugi::xml_node& element, std::vector<city::RawObject>& out, int depth = 0);
  void read_feature(const pugi::xml_node& element, const FeatureClass& what,
                    GeometryContext context, city::RawObject& raw);
  void read_child_features(const pugi::xml_node& property, const GeometryContext& context,
                           city::RawObject& raw);
  void read_child(const pugi::xml_node& element, std::string_view property,
                  const GeometryContext& context, city::RawObject& raw);
  void skip(const pugi::xml_node& element);
  void count_link(std::string_view href);

  pugi::xml_node member_;
  std::size_t line_;
  const GeometryLibrary& library_;
  city::SkipCounter skipped_;
  GeometryWalk geometry_;
  SrsName srs_name_{};
};

/// Returns "Street 12, 10115 Berlin, Germany" from an xAL address, without the parts that are
/// absent.
std::string read_address(const pugi::xml_node& address);

}  // namespace nightcity::citygml
