// The attributes of city objects as an EXT_structural_metadata property table: columns of strings and
// numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/scene_file.h"

namespace nightcity {

constexpr std::string_view feature_class = "cityObject";
constexpr float absent_height = -9999.0f;       // noData of measured_height
constexpr std::int32_t absent_storeys = -9999;  // noData of storeys_above_ground

/// Collects features column by column in scratch files, since a city has hundreds of thousands.
class FeatureTableWriter {
 public:
  explicit FeatureTableWriter(const std::filesystem::path& path);

  std::uint32_t add(const SceneFeature& feature);
  std::uint32_t size() const { return count_; }

  /// Appends the columns to `binary` and returns the extension object; `add_view(offset, size)` registers a
  /// bufferView and returns its index. Call with size() > 0.
  nlohmann::json write(ScratchFile& binary,
                       const std::function<std::size_t(std::uint64_t, std::uint64_t)>& add_view);

 private:
  struct StringColumn {
    explicit StringColumn(const std::filesystem::path& path) : values(path), offsets(path) {}
    void add(std::string_view text);
    ScratchFile values, offsets;
  };
  std::uint32_t count_ = 0;
  StringColumn id_, type_, function_;
  ScratchFile height_, storeys_;
  bool any_height_ = false, any_storeys_ = false;
};

/// Bytes of bufferView `index`; throws Error where there is none.
using ViewBytes = std::function<std::span<const std::byte>(std::size_t index)>;

/// The features of property table `table` of the extension; empty where the table is not of our class.
std::vector<SceneFeature> read_feature_table(const nlohmann::json& extension, std::size_t table,
                                             const ViewBytes& view_bytes);

}  // namespace nightcity
