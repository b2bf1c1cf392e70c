// The names of coordinate reference systems (CRS) in a document: each geometry has its own, that of
// the geometry or feature it is part of, or the document's (GML 3.1.1, 9.10 and 9.4.3).
#pragma once

#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::citygml {

/// Returns the srsName that the element gives itself; "" = none.
std::string_view own_srs_name(const pugi::xml_node& element);

/// Returns the srsName that a feature's extent (gml:boundedBy) gives to the geometry of the
/// feature; "" = none.
std::string_view extent_srs_name(const pugi::xml_node& feature);

/// Returns the srsName that holds for a geometry by what stands above it in its member; "" = none,
/// then it is the document's.
std::string_view find_srs_name(const pugi::xml_node& geometry);

/// Returns the first srsName that a geometry of the member gives itself; "" = none. It holds for
/// the member's other geometry too, where nothing else does: surfaces that a solid takes by links
/// stand beside it, without its name.
std::string_view first_own_srs_name(const pugi::xml_node& member);

/// Names as polygons carry them: null where it is the one that the caller takes the file's
/// coordinates by.
using SrsName = std::shared_ptr<const std::string>;

/// The CRSs that one document names, for all of its members. One thread at a time may use it.
class SrsScope {
 public:
  /// `known`: ReadOptions::srs_name. `document`: the name of the document's own extent, "" = none.
  SrsScope(const std::optional<std::string>& known, const std::string& document);

  /// Returns the name of geometry in members that name none.
  const SrsName& name_of_document() const { return document_; }
  /// Looks at a member: until the next call name_of_rest() is for its geometry.
  void enter(const pugi::xml_node& member);
  /// Returns the name of geometry for which nothing within its member says one.
  const SrsName& name_of_rest() const { return rest_; }
  /// Returns the name that a srsName stands for; `inherited` where it is "".
  SrsName to_name(std::string_view srs_name, const SrsName& inherited);

 private:
  const std::optional<std::string>& known_;
  SrsName document_, rest_;
  std::vector<SrsName> names_;  // those met, so that polygons share them
};

}  // namespace nightcity::citygml
