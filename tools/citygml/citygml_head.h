// Reads from the beginning of a file whether it is CityGML, its version, its
// CRS and some coordinates.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/citygml/member_splitter.h"

namespace nightcity::citygml {

/// Returns whether the root element is one that holds city objects. `start`: the document's first
/// bytes, as many as hold its root's start tag.
bool begins_as_citygml(std::string_view start);

/// Throws Error when the root element is none that holds city objects.
void require_citygml(const DocumentHead& head, const std::string& name);

/// Returns the srsNames in a text, in order, those that are "" left out.
std::vector<std::string> list_srs_names(std::string_view text);

/// Returns the first srsName in the batch's members, as written; "" = none.
std::string first_srs_name(const MemberBatch& batch);

/// Returns the srsName of the document's own extent (boundedBy beside its members), which stands in
/// the first batch; "" = none.
std::string document_srs_name(const MemberBatch& batch);

/// Returns the CityGML documents in a file. In an archive others lie beside them, as metadata and
/// code lists do: they are passed over, each with a warning in `warnings` (null: none). Throws
/// Error as list_documents does, and where the file holds no CityGML document.
std::vector<city::Document> list_citygml_documents(const std::filesystem::path& file,
                                                   std::vector<std::string>* warnings);

/// The name of the CRS is that of the first ring: its own, or that of what it is part of, or the
/// document's (srs_scope.h). Reads until it has a sample or the file ends. In the sample rings are
/// closed again, so that one can see where they end. Throws Error as read_citygml does.
city::CityHead read_citygml_head(const std::filesystem::path& file,
                                 const city::ReadOptions& options = {});
/// The same of documents.
city::CityHead read_documents_head(std::span<const city::Document> documents,
                                   const city::ReadOptions& options);

}  // namespace nightcity::citygml
