#include "formats/draco_codec.h"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <unordered_map>

#include "formats/error.h"

namespace nightcity {
namespace {

constexpr int max_bits = 30;  // Draco's own limit
constexpr int encoding_speed =
    3;  // compression level 7 (10 - 7): more takes much longer and saves little

int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type,
                  std::span<const float> values, int components) {
  draco::GeometryAttribute attribute;
  const auto stride = static_cast<std::int64_t>(sizeof(float)) * components;
  attribute.Init(type, nullptr, static_cast<std::uint8_t>(components), draco::DT_FLOAT32, false,
                 stride, 0);
  const auto count = values.size() / static_cast<std::size_t>(components);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(count));
  for (std::size_t i = 0; i < count; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(static_cast<std::uint32_t>(i)),
                                          &values[i * static_cast<std::size_t>(components)]);
  return id;
}

// Quantises whole numbers with a step of exactly 1, so that they are decoded exactly.
void quantise_whole_numbers(draco::ExpertEncoder& encoder, int attribute,
                            std::span<const float> values) {
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  int bits = 1;
  while (std::ldexp(1.0, bits) - 1 < double{*max} - double{*min}) ++bits;
  const float origin = *min, range = static_cast<float>(std::ldexp(1.0, bits) - 1);
  encoder.SetAttributeExplicitQuantization(attribute, bits, 1, &origin, range);
}

// Draco's Edgebreaker reorders vertices. Each original vertex is matched to the nearest decoded
// one, found in a hash grid.
double max_displacement(std::span<const glm::vec3> originals, std::span<const glm::vec3> decoded,
                        const glm::vec3& origin, double reach) {
  const double cell = 8 * reach;  // large, so that few vertices need a look into neighbouring cells
  const auto key = [](const glm::dvec3& c) {
    const auto part = [](double v) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(v)) & 0x1FFFFFu;
    };
    return part(c.x) << 42 | part(c.y) << 21 | part(c.z);
  };
  const auto cell_of = [&](const glm::dvec3& p) {
    return glm::floor((p - glm::dvec3(origin)) / cell);
  };
  std::unordered_multimap<std::uint64_t, std::uint32_t> grid;
  grid.reserve(decoded.size());
  for (std::uint32_t i = 0; i < decoded.size(); ++i)
    grid.emplace(key(cell_of(glm::dvec3(decoded[i]))), i);

  double worst = 0;
  for (const glm::vec3& original : originals) {
    const glm::dvec3 p(original), low = cell_of(p - reach), high = cell_of(p + reach);
    double nearest = std::numeric_limits<double>::infinity();
    for (double x = low.x; x <= high.x; ++x)
      for (double y = low.y; y <= high.y; ++y)
        for (double z = low.z; z <= high.z; ++z) {
          const auto [begin, end] = grid.equal_range(key({x, y, z}));
          for (auto i = begin; i != end; ++i)
            nearest = std::min(nearest, glm::distance(p, glm::dvec3(decoded[i->second])));
        }
    worst = std::max(worst, nearest);
  }
  return worst;
}

}  // namespace

int draco_bits(double extent_m, double tolerance_m) {
  const double steps = extent_m * std::sqrt(3.0) / (2 * tolerance_m);
  return std::clamp(static_cast<int>(std::ceil(std::log2(steps + 1))), 1, max_bits);
}

std::optional<DracoEncoded> encode_draco(const ScenePrimitive& primitive,
                                         std::span<const float> feature_ids,
                                         std::span<const float> light_ids, double tolerance_m) {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(primitive.positions.size()));
  mesh.SetNumFaces(primitive.indices.size() / 3);
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const auto point = [&](std::size_t k) { return draco::PointIndex(primitive.indices[i + k]); };
    mesh.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(i / 3)),
                 {{point(0), point(1), point(2)}});
  }
  glm::vec3 least(std::numeric_limits<float>::infinity()), greatest(-least);
  for (const glm::vec3& p : primitive.positions) {
    least = glm::min(least, p);
    greatest = glm::max(greatest, p);
  }
  const glm::dvec3 size = glm::dvec3(greatest) - glm::dvec3(least);

  DracoEncoded result;
  result.bits = draco_bits(std::max({size.x, size.y, size.z}), tolerance_m);
  const std::span<const float> coordinates(&primitive.positions[0].x,
                                           primitive.positions.size() * 3);
  const int position = add_attribute(mesh, draco::GeometryAttribute::POSITION, coordinates, 3);
  const auto add_ids = [&](std::span<const float> ids) {
    return ids.empty() ? -1 : add_attribute(mesh, draco::GeometryAttribute::GENERIC, ids, 1);
  };
  const int feature = add_ids(feature_ids), light = add_ids(light_ids);
  const auto unique_id = [&](int id) {
    return id < 0 ? -1 : static_cast<int>(mesh.attribute(id)->unique_id());
  };
  result.position_id = unique_id(position);
  result.feature_id = unique_id(feature);
  result.light_id = unique_id(light);

  draco::ExpertEncoder encoder(mesh);
  encoder.SetSpeedOptions(encoding_speed, encoding_speed);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(position, result.bits);
  if (feature >= 0) quantise_whole_numbers(encoder, feature, feature_ids);
  if (light >= 0) quantise_whole_numbers(encoder, light, light_ids);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) return std::nullopt;
  result.bytes.assign(buffer.data(), buffer.data() + buffer.size());

  const DracoAttribute wanted{static_cast<std::uint32_t>(result.position_id), 3};
  const DracoDecoded decoded = decode_draco(std::as_bytes(std::span(result.bytes)), {&wanted, 1});
  if (decoded.indices.empty()) return std::nullopt;
  const auto& values = decoded.attributes[0];
  std::vector<glm::vec3> positions(values.size() / 3);
  result.min = glm::vec3(std::numeric_limits<float>::infinity());
  result.max = -result.min;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    result.min = glm::min(result.min, positions[i]);
    result.max = glm::max(result.max, positions[i]);
  }
  result.vertex_count = static_cast<std::uint32_t>(positions.size());
  result.index_count = static_cast<std::uint32_t>(decoded.indices.size());

  // Draco leaves out vertices that no triangle uses.
  std::vector<bool> used(primitive.positions.size());
  for (const std::uint32_t index : primitive.indices) used[index] = true;
  std::vector<glm::vec3> originals;
  originals.reserve(primitive.positions.size());
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) originals.push_back(primitive.positions[i]);
  // Rounding the decoded coordinate to float adds to the error of the quantisation.
  const glm::vec3 magnitude = glm::max(glm::abs(least), glm::abs(greatest));
  const double rounding = std::max({magnitude.x, magnitude.y, magnitude.z}) * 0x1p-22;
  const double allowed = tolerance_m + rounding;
  result.error_m = max_displacement(originals, positions, least, allowed);
  if (!(result.error_m <= allowed)) return std::nullopt;
  return result;
}

DracoDecoded decode_draco(std::span<const std::byte> bytes,
                          std::span<const DracoAttribute> attributes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) throw Error("", "Draco", decoded.status().error_msg_string());
  const draco::Mesh& mesh = *decoded.value();

  DracoDecoded result;
  result.indices.reserve(std::size_t{3} * mesh.num_faces());
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k)
      result.indices.push_back(mesh.face(draco::FaceIndex(f))[static_cast<std::size_t>(k)].value());
  for (const DracoAttribute& wanted : attributes) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (!attribute || attribute->num_components() != wanted.components)
      throw Error("", "Draco",
                  "attribute " + std::to_string(wanted.id) + " is missing or of another size");
    const auto components = static_cast<std::size_t>(wanted.components);
    std::vector<float> values(components * mesh.num_points());
    for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
      const auto index = attribute->mapped_index(draco::PointIndex(p));
      if (index.value() >= attribute->size() ||
          !attribute->ConvertValue<float>(index, static_cast<std::int8_t>(components),
                                          &values[components * p]))
        throw Error("", "Draco", "attribute " + std::to_string(wanted.id) + " cannot be read");
    }
    result.attributes.push_back(std::move(values));
  }
  return result;
}

}  // namespace nightcity
