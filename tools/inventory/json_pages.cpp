#include "tools/inventory/json_pages.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/cityjson/json.h"
#include "tools/inventory/server_limit.h"

namespace nightcity::inventory {
namespace {

using cityjson::find_member;
using cityjson::find_object;
using cityjson::find_text;
using simdjson::dom::element;
using simdjson::dom::object;

struct Total {
  std::string_view key;
  std::size_t rows;
};

// OpenDataSoft (2 and 1), CKAN, Django, OData, GeoServer, OGC API, Solr, ...
std::optional<Total> find_total(const std::vector<object>& places) {
  constexpr std::array<std::string_view, 15> keys{
      "total_count", "nhits",       "numberMatched", "totalFeatures", "total",
      "totalCount",  "total_rows",  "totalRecords",  "recordsTotal",  "totalElements",
      "totalItems",  "total_items", "numFound",      "@odata.count",  "count"};
  for (const std::string_view key : keys)
    for (const object& place : places)
      if (const auto value = find_member(place, key))
        if (const auto rows = cityjson::to_index(*value)) return Total{key, *rows};
  return {};
}

// Returns whether a member is an address or the mark of a page.
bool leads_on(const element& value) {
  if (std::string_view text; value.get(text) == simdjson::SUCCESS) return !text.empty();
  object link;
  if (value.get(link) == simdjson::SUCCESS) return !find_text(link, "href").empty();
  return false;
}

bool has_next_page(const std::vector<object>& places) {
  constexpr std::array<std::string_view, 10> keys{
      "next",          "next_page",     "nextPage",        "nextLink",        "next_url",
      "next_page_url", "nextPageToken", "next_page_token", "@odata.nextLink", "odata.nextLink"};
  for (const object& place : places) {
    for (const std::string_view key : keys)
      if (const auto value = find_member(place, key); value && leads_on(*value)) return true;
    if (const auto links = cityjson::find_array(place, "links"))
      for (const element& value : *links)
        if (object link; value.get(link) == simdjson::SUCCESS && find_text(link, "rel") == "next")
          return true;
  }
  return false;
}

}  // namespace

std::string find_missing_rows(const object& beside, std::size_t rows) {
  constexpr std::array<std::string_view, 8> pagings{"links", "_links", "paging", "pagination",
                                                    "meta",  "info",   "page",   "properties"};
  std::vector<object> places{beside};
  for (const std::string_view key : pagings)
    if (const auto inside = find_object(beside, key)) places.push_back(*inside);
  for (const object& place : places)
    if (const auto limit = find_member(place, "exceededTransferLimit"))
      if (bool exceeded = false; limit->get(exceeded) == simdjson::SUCCESS && exceeded)
        return say_part_of_rows("exceededTransferLimit");
  // CKAN links to a next page behind the last one too.
  if (const auto total = find_total(places))
    return total->rows > rows ? say_some_of_rows(rows, total->rows, total->key) : "";
  return has_next_page(places) ? say_one_page() : "";
}

}  // namespace nightcity::inventory
