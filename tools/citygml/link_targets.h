// Fetches the targets of links of a document from wherever they stand.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"
#include "tools/citygml/linked_features.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {

/// Returns the neighbours, and beside them the documents of one archive, which may link to each
/// other. It takes time in their number, and is for all of them.
std::shared_ptr<const std::set<std::filesystem::path>> add_siblings(
    const std::shared_ptr<const std::set<std::filesystem::path>>& neighbours,
    std::span<const city::Document> siblings);

class LinkTargets {
 public:
  /// Links of `document` may lead into itself and the neighbours of the options, of which `siblings`
  /// (the documents of its archive) are found there. All must outlive the targets.
  LinkTargets(const city::Document& document, std::span<const city::Document> siblings,
              const city::ReadOptions& options);

  GeometryLibrary& library() { return library_; }
  const GeometryLibrary& library() const { return library_; }
  LinkedFeatures& features() { return features_; }
  const LinkedFeatures& features() const { return features_; }

  /// Fetches the geometry of these names, and the features that features() has noted. What cannot
  /// be followed goes to `warnings`. `document_srs_name`: of the document's own extent.
  void fetch(const std::unordered_set<std::string>& geometry, const std::string& document_srs_name,
             std::vector<std::string>& warnings);

 private:
  template <class Names, class Take>
  void visit_targets(const Names& names, std::vector<std::string>& warnings, const Take& take);
  std::vector<city::Document> list_targets(const std::filesystem::path& file) const;
  void take_geometry(const city::Document& document, const std::unordered_set<std::string>& ids,
                     const std::string& prefix, const std::string& document_srs_name,
                     std::vector<std::string>& warnings);
  void take_features(const city::Document& document, const std::unordered_set<std::string>& ids,
                     const std::string& prefix);

  const city::Document& document_;
  std::span<const city::Document> siblings_;
  const city::ReadOptions& options_;
  GeometryLibrary library_;
  LinkedFeatures features_;
  std::uint64_t next_linked_ = 1;
  std::size_t room_;
};

}  // namespace nightcity::citygml
