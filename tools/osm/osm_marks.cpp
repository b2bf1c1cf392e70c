#include "tools/osm/osm_marks.h"

#include "formats/packed_file.h"
#include "formats/to_lower.h"

namespace nightcity::osm {
namespace {

using std::string_view;
using namespace std::string_view_literals;

/// Returns whether the text begins as a line of OPL: "n17 v1 ..." (node),
/// "w" (way), "r" (relation).
bool is_opl(string_view start) {
  if (start.empty() || "nwr"sv.find(start.front()) == string_view::npos) return false;
  std::size_t at = start.substr(1).starts_with('-') ? 2 : 1;
  const std::size_t first = at;
  while (at < start.size() && start[at] >= '0' && start[at] <= '9') ++at;
  return at > first && (start.substr(at).starts_with(" v") || start.substr(at).starts_with(" d") ||
                        start.substr(at).starts_with(" T") || start.substr(at).starts_with(" x"));
}

}  // namespace

// A PBF begins with the length of a blob header whose first field is the text "OSMHeader".
bool is_osm_pbf(string_view start) {
  return start.size() > 16 && start.substr(4, 11) == "\x0a\x09OSMHeader";
}

bool is_o5m(string_view start) {
  return start.starts_with("\xff\xe0");
}

bool is_xml(string_view start) {
  if (start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff")) return true;
  if (start.starts_with("\xef\xbb\xbf")) start.remove_prefix(3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  return first != string_view::npos && start[first] == '<';
}

bool is_bzip2(string_view start) {
  return start.starts_with("BZh");
}

std::string describe_unread_osm(string_view start) {
  if (const string_view packed = describe_packed(start); !packed.empty())
    return std::string(packed);
  if (start.starts_with("\xff\xe0\x04o5c2"))
    return "is a change file (o5c), not a map: apply it to one by `osmium apply-changes`";
  if (is_opl(start)) return "is OSM in OPL: convert it by `osmium cat IN.opl -o OUT.osm.pbf`";
  if (start.starts_with("\xef\xbb\xbf")) start.remove_prefix(3);
  const std::string text = to_lower(start);
  const auto holds = [&](string_view part) { return text.find(part) != std::string::npos; };
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  if (holds("<osmchange"))
    return "is a change file (osmChange), not a map: apply it to one by `osmium apply-changes`";
  if (holds("<!doctype html") || holds("<html"))
    return "is a web page, not a map: the download failed, or its address needs a login";
  if (text.starts_with("@id") || text.starts_with("@type"))
    return "is an answer of Overpass in CSV: ask for XML by [out:xml] and `out meta geom;`";
  return {};
}

}  // namespace nightcity::osm
