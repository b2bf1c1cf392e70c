#include "tools/elevation/osm_elevations.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <osmium/builder/osm_object_builder.hpp>
#include <osmium/io/any_input.hpp>
#include <osmium/io/any_output.hpp>
#include <osmium/osm.hpp>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/input_file.h"
#include "tools/osm/map_file.h"
#include "tools/osm/packed_map.h"
#include "tools/osm/whole_tags.h"

namespace nightcity::elevation {
namespace {

namespace fs = std::filesystem;

std::string text_of(double height) {
  return fmt::format("{:.2f}", height);
}

/// Returns libosmium's name for the kind of file; "" where the file's name says none.
std::string format_of(const fs::path& path) {
  const std::string name = path.filename().string();
  constexpr std::pair<std::string_view, const char*> formats[] = {
      {".osm.pbf", "pbf"},     {".pbf", "pbf"}, {".osm.gz", "osm.gz"},
      {".osm.bz2", "osm.bz2"}, {".osm", "osm"}, {".xml", "osm"}};
  for (const auto& [end, format] : formats)
    if (name.ends_with(end)) return format;
  return {};
}

bool is_text(const fs::path& path) {
  refuse_special_file(path);
  std::ifstream file(path, std::ios::binary);
  std::array<char, 64> bytes{};
  file.read(bytes.data(), bytes.size());
  const std::string_view head(bytes.data(), static_cast<std::size_t>(file.gcount()));
  const std::size_t first = head.find_first_not_of("\xef\xbb\xbf \t\r\n");
  return first != std::string_view::npos && head[first] == '<';
}

struct FileSink : pugi::xml_writer {
  AtomicFile& file;
  explicit FileSink(AtomicFile& f) : file(f) {}
  void write(const void* data, std::size_t size) override { file.write(data, size); }
};

std::size_t edit_xml(const fs::path& input, const fs::path& output,
                     const std::map<std::int64_t, double>& heights) {
  pugi::xml_document document;
  const auto parsed = document.load_file(input.c_str(), pugi::parse_full & ~pugi::parse_doctype);
  if (!parsed) throw Error(input.string(), std::string("broken XML: ") + parsed.description());
  std::size_t written = 0;
  for (pugi::xml_node node : document.child("osm").children("node")) {
    const auto height = heights.find(node.attribute("id").as_llong());
    if (height == heights.end()) continue;
    pugi::xml_node tag = node.find_child_by_attribute("tag", "k", "ele");
    if (!tag) {
      tag = node.append_child("tag");
      tag.append_attribute("k") = "ele";
      tag.append_attribute("v");
    }
    if (!tag.attribute("v")) tag.append_attribute("v");
    tag.attribute("v") = text_of(height->second).c_str();
    ++written;
  }
  AtomicFile file(output);
  FileSink sink(file);
  document.save(sink, "  ", pugi::format_indent, pugi::encoding_utf8);
  file.commit();
  return written;
}

/// Copies the node with its tags, `ele` replaced.
void add_node(osmium::memory::Buffer& buffer, const osmium::Node& node, double height) {
  {
    osmium::builder::NodeBuilder builder(buffer);
    builder.set_id(node.id())
        .set_version(node.version())
        .set_visible(node.visible())
        .set_changeset(node.changeset())
        .set_uid(node.uid())
        .set_timestamp(node.timestamp());
    const std::string user = node.user();
    builder.set_location(node.location());
    builder.set_user(user.data(), static_cast<osmium::string_size_type>(user.size()));
    osmium::builder::TagListBuilder tags(builder);
    for (const osmium::Tag& tag : node.tags())
      if (std::string_view(tag.key()) != "ele") tags.add_tag(tag.key(), tag.value());
    tags.add_tag("ele", text_of(height).c_str());
  }
  buffer.commit();
}

std::size_t copy_packed(const fs::path& input, const fs::path& output, const std::string& format,
                        const std::map<std::int64_t, double>& heights) {
  std::size_t written = 0;
  AtomicPath file(output);
  try {
    osmium::io::Reader reader(osm::open_packed_map(input));
    osmium::io::Writer writer(osmium::io::File(file.scratch().string(), format), reader.header(),
                              osmium::io::overwrite::allow);
    while (osmium::memory::Buffer buffer = reader.read()) {
      osmium::memory::Buffer changed(buffer.committed() + 1024,
                                     osmium::memory::Buffer::auto_grow::yes);
      for (const osmium::OSMObject& object : buffer.select<osmium::OSMObject>())
        osm::require_whole_tags(object.tags());
      for (const osmium::OSMEntity& entity : buffer.select<osmium::OSMEntity>()) {
        const auto height = entity.type() == osmium::item_type::node
                                ? heights.find(static_cast<const osmium::Node&>(entity).id())
                                : heights.end();
        if (height == heights.end()) {
          changed.add_item(entity);
          changed.commit();
        } else {
          add_node(changed, static_cast<const osmium::Node&>(entity), height->second);
          ++written;
        }
      }
      writer(std::move(changed));
    }
    writer.close();
    reader.close();
    file.commit();
  } catch (const std::exception& error) {
    throw Error(output.string(),
                std::string("cannot be made of ") + input.string() + ": " + error.what());
  }
  return written;
}

}  // namespace

std::size_t write_elevations(const fs::path& input, const fs::path& output,
                             const std::map<std::int64_t, double>& heights) {
  const std::string format = format_of(output);
  if (format.empty())
    throw Error(output.string(), "is named like no OSM file: .osm, .osm.pbf, .osm.gz, .osm.bz2");
  return osm::read_map_file(input, [&](const fs::path& plain) {
    if (format == "osm" && is_text(plain)) return edit_xml(plain, output, heights);
    return copy_packed(plain, output, format, heights);
  });
}

}  // namespace nightcity::elevation
