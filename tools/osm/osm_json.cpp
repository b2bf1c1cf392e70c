#include "tools/osm/osm_json.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <string>

#include "formats/error.h"
#include "formats/json_parse.h"

namespace nightcity::osm {
namespace {

using nlohmann::json;

std::string to_text(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

void copy(const json& from, const char* key, pugi::xml_node to, const char* attribute) {
  const auto value = from.find(key);
  if (value != from.end() && value->is_primitive() && !value->is_null())
    to.append_attribute(attribute) = to_text(*value).c_str();
}

void copy(const json& from, pugi::xml_node to, std::initializer_list<const char*> keys) {
  for (const char* key : keys) copy(from, key, to, key);
}

const json* find(const json& element, const char* key, json::value_t type) {
  const auto value = element.find(key);
  return value != element.end() && value->type() == type ? &*value : nullptr;
}

// Adds what `out geom` says of each node of a way; null where it lies outside of the box.
void copy_places(const json* geometry, std::size_t n, pugi::xml_node to) {
  if (geometry && n < geometry->size() && (*geometry)[n].is_object())
    copy((*geometry)[n], to, {"lat", "lon"});
}

void copy_nodes(const json& from, pugi::xml_node to) {
  const json* nodes = find(from, "nodes", json::value_t::array);
  const json* geometry = find(from, "geometry", json::value_t::array);
  const std::size_t count = nodes ? nodes->size() : geometry ? geometry->size() : 0;
  for (std::size_t n = 0; n < count; ++n) {
    pugi::xml_node reference = to.append_child("nd");
    if (nodes) reference.append_attribute("ref") = to_text((*nodes)[n]).c_str();
    copy_places(geometry, n, reference);
  }
}

void copy_members(const json& members, pugi::xml_node to) {
  for (const json& from : members) {
    if (!from.is_object()) continue;
    pugi::xml_node member = to.append_child("member");
    copy(from, member, {"type", "ref", "role", "lat", "lon"});
    const json* geometry = find(from, "geometry", json::value_t::array);
    for (std::size_t n = 0; geometry && n < geometry->size(); ++n)
      copy_places(geometry, n, member.append_child("nd"));
  }
}

void add_element(const json& from, pugi::xml_node root) {
  const json* type = find(from, "type", json::value_t::string);
  if (!type || (*type != "node" && *type != "way" && *type != "relation")) return;
  pugi::xml_node to = root.append_child(to_text(*type).c_str());
  copy(from, to, {"id", "lat", "lon", "version", "visible", "timestamp"});
  if (const json* centre = find(from, "center", json::value_t::object))
    copy(*centre, to.append_child("center"), {"lat", "lon"});
  copy_nodes(from, to);
  if (const json* members = find(from, "members", json::value_t::array)) copy_members(*members, to);
  const json* tags = find(from, "tags", json::value_t::object);
  if (!tags) return;
  for (const auto& [key, value] : tags->items()) {
    pugi::xml_node tag = to.append_child("tag");
    tag.append_attribute("k") = key.c_str();
    tag.append_attribute("v") = to_text(value).c_str();
  }
}

struct Writer : pugi::xml_writer {
  explicit Writer(ScratchFile& to) : file(to) {}
  void write(const void* bytes, std::size_t size) override { file.write(bytes, size); }
  ScratchFile& file;
};

}  // namespace

bool begins_as_osm_json(std::string_view start) {
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == start.npos || start[first] != '{') return false;
  const auto holds = [start](std::string_view text) { return start.find(text) != start.npos; };
  if (holds("\"osm3s\"")) return true;
  if (!holds("\"elements\"")) return false;
  // A program that sorts keys puts the elements first, and what the server says behind them.
  constexpr std::array<std::string_view, 6> marks{"\"generator\"", "\"version\"",  "\"node\"",
                                                  "\"way\"",       "\"relation\"", "\"minlat\""};
  return std::any_of(marks.begin(), marks.end(), holds);
}

void write_as_xml(const city::Document& file, ScratchFile& xml, std::size_t max_bytes) {
  const std::string text = city::read_next(*file.open(), max_bytes + 1);
  if (text.size() > max_bytes)
    throw Error(file.name, "is a map in JSON of more than " + std::to_string(max_bytes >> 20) +
                               " MB, which would be held in memory: ask for XML, or take an "
                               "extract in PBF");
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("osm");
  root.append_attribute("generator") = "Overpass";
  // An element is kept no longer than it takes to copy it.
  const auto take = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > static_cast<int>(max_json_depth))
      throw Error(file.name, "is JSON of more than " + std::to_string(max_json_depth) +
                                 " arrays and objects in each other");
    if (depth != 2 || event != json::parse_event_t::object_end) return true;
    add_element(value, root);
    return false;
  };
  try {
    const json rest = json::parse(text, take);
    if (const json* bounds = find(rest, "bounds", json::value_t::object))
      copy(*bounds, root.append_child("bounds"), {"minlat", "minlon", "maxlat", "maxlon"});
    if (const json* remark = find(rest, "remark", json::value_t::string))
      root.append_child("remark").text() = to_text(*remark).c_str();
  } catch (const json::exception& error) {
    throw Error(file.name, "is no whole JSON: " + describe(error));
  }
  Writer writer(xml);
  document.save(writer, "", pugi::format_raw);
  xml.flush();
}

}  // namespace nightcity::osm
