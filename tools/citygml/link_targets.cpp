#include "tools/citygml/link_targets.h"

#include <filesystem>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <utility>

#include "tools/citygml/citygml_head.h"
#include "tools/citygml/member_splitter.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/shared_geometry.h"

namespace nightcity::citygml {
namespace {

namespace fs = std::filesystem;

// Linked features may take as much text as that many vertices do, with a dozen digits each.
std::size_t find_linked_bytes(const city::ReadOptions& options) {
  constexpr std::size_t vertex_bytes = 40;
  return vertex_bytes * static_cast<std::size_t>(options.max_linked_vertices);
}

}  // namespace

std::shared_ptr<const std::set<fs::path>> add_siblings(
    const std::shared_ptr<const std::set<fs::path>>& neighbours,
    std::span<const city::Document> siblings) {
  if (siblings.size() < 2) return neighbours;
  auto all = std::make_shared<std::set<fs::path>>();
  if (neighbours) *all = *neighbours;
  for (const city::Document& sibling : siblings)
    all->insert(fs::path(sibling.name).lexically_normal());
  return all;
}

LinkTargets::LinkTargets(const city::Document& document, std::span<const city::Document> siblings,
                         const city::ReadOptions& options)
    : document_(document),
      siblings_(siblings),
      options_(options),
      features_(find_linked_bytes(options)),
      room_(static_cast<std::size_t>(options.max_linked_vertices)) {
  library_.folder = fs::path(document.name).parent_path();
  library_.file_name = fs::path(document.name).filename().string();
  library_.neighbours = options.neighbours;
  library_.max_vertices = room_;
}

std::vector<city::Document> LinkTargets::list_targets(const fs::path& file) const {
  for (const city::Document& sibling : siblings_)
    if (fs::path(sibling.name).lexically_normal() == file) return {sibling};
  return list_citygml_documents(file, nullptr);
}

// Calls `take(document, ids, prefix)` for each document that such names lead to.
template <class Names, class Take>
void LinkTargets::visit_targets(const Names& names, std::vector<std::string>& warnings,
                                const Take& take) {
  std::map<fs::path, std::unordered_set<std::string>> by_file;  // "" = this one
  for (const std::string& name : names) {
    auto [file, id] = library_.split_name(name);
    by_file[std::move(file)].insert(std::move(id));
  }
  for (const auto& [file, ids] : by_file) {
    if (file.empty()) {
      take(document_, ids, std::string());
      continue;
    }
    const std::vector<city::Document> targets = list_targets(file);
    const auto find_srs_name = [&](std::span<const city::Document> documents) {
      return read_documents_head(documents, options_).srs_name;
    };
    if (find_srs_name(targets) != find_srs_name({&document_, 1})) {
      warnings.push_back(document_.name + ": xlinks into " + file.string() +
                         " are not followed: it is in another CRS");
      continue;
    }
    for (const city::Document& target : targets) take(target, ids, file.string() + "#");
  }
}

void LinkTargets::take_geometry(const city::Document& document,
                                const std::unordered_set<std::string>& ids,
                                const std::string& prefix, const std::string& document_srs_name,
                                std::vector<std::string>& warnings) {
  FetchedGeometry fetched =
      fetch_geometry(document, ids, options_, document_srs_name, next_linked_, room_);
  for (auto& [id, polygons] : fetched.polygons)
    library_.polygons.emplace(prefix + id, std::move(polygons));
  if (fetched.beyond_room > 0)
    warnings.push_back(document.name + ": " + std::to_string(fetched.beyond_room) +
                       " links are not followed: what they lead to has more vertices than [city] "
                       "max_linked_vertices = " +
                       std::to_string(options_.max_linked_vertices) + " in a recipe allows");
}

void LinkTargets::take_features(const city::Document& document,
                                const std::unordered_set<std::string>& ids,
                                const std::string& prefix) {
  const auto source = document.open();
  MemberSplitter splitter(*source, document.name, limits_of(options_));
  const auto encoding = splitter.head().latin1 ? pugi::encoding_latin1 : pugi::encoding_utf8;
  MemberBatch batch;
  while (splitter.next(batch))
    for (const MemberBatch::Member& member : batch.members) {
      pugi::xml_document xml;
      if (xml.load_buffer_inplace(batch.bytes.get() + member.begin, member.size, gml_parse_flags,
                                  encoding))
        features_.fetch_from(xml, ids, prefix, library_);
    }
}

void LinkTargets::fetch(const std::unordered_set<std::string>& geometry,
                        const std::string& document_srs_name, std::vector<std::string>& warnings) {
  visit_targets(geometry, warnings,
                [&](const city::Document& document, const auto& ids, const std::string& prefix) {
                  take_geometry(document, ids, prefix, document_srs_name, warnings);
                });
  visit_targets(features_.list_wanted(), warnings,
                [&](const city::Document& document, const auto& ids, const std::string& prefix) {
                  take_features(document, ids, prefix);
                });
  features_.assign();
  if (features_.beyond_room() > 0)
    warnings.push_back(document_.name + ": " + std::to_string(features_.beyond_room()) +
                       " links to objects are not followed: these have more text than [city] "
                       "max_linked_vertices = " +
                       std::to_string(options_.max_linked_vertices) + " in a recipe allows");
}

}  // namespace nightcity::citygml
