#include "formats/feature_table.h"

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "formats/gltf_constants.h"
#include "formats/json_parse.h"

namespace nightcity {
namespace {

using nlohmann::json;

constexpr std::size_t column_alignment = 8;  // required by EXT_structural_metadata

// Returns the values of a column, checked to hold at least `count` elements of T.
template <class T>
std::span<const std::byte> column(const json& property, const char* key, std::size_t count,
                                  const ViewBytes& view) {
  const auto bytes = view(property.at(key).get<std::size_t>());
  if (bytes.size() / sizeof(T) < count)
    throw Error("", "property table", std::string(key) + " is too short");
  return bytes.first(count * sizeof(T));
}

template <class T>
T element(std::span<const std::byte> bytes, std::size_t i) {
  T value;
  std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
  return value;
}

void read_strings(const json& properties, const char* name, std::string SceneFeature::*member,
                  std::vector<SceneFeature>& features, const ViewBytes& view) {
  if (!properties.contains(name)) return;
  const json& property = properties.at(name);
  if (property.value("stringOffsetType", "UINT32") != "UINT32")
    throw Error("", "property table", "string offsets that are not UINT32");
  const auto offsets = column<std::uint32_t>(property, "stringOffsets", features.size() + 1, view);
  const auto text = view(property.at("values").get<std::size_t>());
  for (std::size_t i = 0; i < features.size(); ++i) {
    const auto begin = element<std::uint32_t>(offsets, i),
               end = element<std::uint32_t>(offsets, i + 1);
    if (begin > end || end > text.size())
      throw Error("", "property table", "string lies outside its column");
    (features[i].*member).assign(reinterpret_cast<const char*>(text.data()) + begin, end - begin);
  }
}

}  // namespace

FeatureTableWriter::FeatureTableWriter(const std::filesystem::path& path)
    : id_(path), type_(path), function_(path), provenance_(path), height_(path), storeys_(path) {}

void FeatureTableWriter::StringColumn::add(std::string_view text) {
  const std::uint32_t offset = static_cast<std::uint32_t>(values.size());
  offsets.write(&offset, sizeof offset);
  values.write(text.data(), text.size());
  if (values.size() > 0xFFFFFFFFu) throw Error("", "feature attributes", "more than 4 GiB of text");
}

std::uint32_t FeatureTableWriter::add(const SceneFeature& feature) {
  // Feature ids are stored as floats (gltf_constants.h).
  if (count_ >= gltf::max_id) throw Error("", "more than 8,388,607 features");
  id_.add(feature.id);
  type_.add(feature.type);
  function_.add(feature.function);
  provenance_.add(feature.provenance);
  float height = absent_height;
  if (feature.measured_height_m && std::isfinite(*feature.measured_height_m)) {
    height = static_cast<float>(*feature.measured_height_m);
    any_height_ = true;
  }
  height_.write(&height, sizeof height);
  std::int32_t storeys = absent_storeys;
  if (feature.storeys_above_ground) {
    storeys = *feature.storeys_above_ground;
    any_storeys_ = true;
  }
  storeys_.write(&storeys, sizeof storeys);
  return count_++;
}

json FeatureTableWriter::write(
    ScratchFile& binary, const std::function<std::size_t(std::uint64_t, std::uint64_t)>& add_view) {
  const auto append = [&](ScratchFile& data) {
    binary.align(column_alignment);
    const std::uint64_t offset = binary.size();
    data.copy_to(binary);
    return add_view(offset, data.size());
  };
  json columns = json::object(), schema = json::object();
  const auto strings = [&](const char* name, StringColumn& column) {
    if (column.values.size() == 0)
      return;  // a bufferView may not be empty, and all values of the column are
    const std::uint32_t end = static_cast<std::uint32_t>(column.values.size());
    column.offsets.write(&end, sizeof end);
    columns[name] = {{"values", append(column.values)}, {"stringOffsets", append(column.offsets)}};
    schema[name] = {{"type", "STRING"}};
  };
  strings("id", id_);
  strings("type", type_);
  strings("function", function_);
  strings("provenance", provenance_);
  if (any_height_) {
    columns["measured_height"] = {{"values", append(height_)}};
    schema["measured_height"] = {{"type", "SCALAR"},
                                 {"componentType", "FLOAT32"},
                                 {"noData", absent_height},
                                 {"description", "height of the object, m"}};
  }
  // Always written, so that a table has at least one column, from which readers know its length.
  columns["storeys_above_ground"] = {{"values", append(storeys_)}};
  schema["storeys_above_ground"] = {
      {"type", "SCALAR"}, {"componentType", "INT32"}, {"noData", absent_storeys}};

  return {{"schema",
           {{"id", "nightcity"},
            {"classes", {{feature_class, {{"name", "City object"}, {"properties", schema}}}}}}},
          {"propertyTables",
           {{{"name", "City objects"},
             {"class", feature_class},
             {"count", count_},
             {"properties", columns}}}}};
}

std::vector<SceneFeature> read_feature_table(const json& extension, std::size_t table,
                                             const ViewBytes& view) {
  try {
    const json& description = extension.at("propertyTables").at(table);
    if (description.value("class", "") != feature_class || !description.contains("properties"))
      return {};
    const json& properties = description.at("properties");
    if (!properties.contains("storeys_above_ground")) return {};
    const auto count = description.at("count").get<std::uint64_t>();
    // Checks the count against the bytes of a column before memory for it is allocated.
    const auto storeys = column<std::int32_t>(properties.at("storeys_above_ground"), "values",
                                              static_cast<std::size_t>(count), view);
    std::vector<SceneFeature> features(static_cast<std::size_t>(count));
    read_strings(properties, "id", &SceneFeature::id, features, view);
    read_strings(properties, "type", &SceneFeature::type, features, view);
    read_strings(properties, "function", &SceneFeature::function, features, view);
    read_strings(properties, "provenance", &SceneFeature::provenance, features, view);
    for (std::size_t i = 0; i < features.size(); ++i)
      if (const auto value = element<std::int32_t>(storeys, i); value != absent_storeys)
        features[i].storeys_above_ground = value;
    if (properties.contains("measured_height")) {
      const auto heights =
          column<float>(properties.at("measured_height"), "values", features.size(), view);
      for (std::size_t i = 0; i < features.size(); ++i)
        if (const auto value = element<float>(heights, i);
            value != absent_height && std::isfinite(value))
          features[i].measured_height_m = value;
    }
    return features;
  } catch (const json::exception& error) {
    throw Error("", "EXT_structural_metadata", describe(error));
  }
}

}  // namespace nightcity
