// The attributes of city objects as a property table of EXT_structural_metadata: columns of strings
// and numbers.
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

#include "formats/scene.h"
#include "formats/scratch_file.h"

namespace nightcity {

constexpr std::string_view feature_class = "cityObject";
constexpr float absent_height = -9999.0f;       // noData of measured_height
constexpr std::int32_t absent_storeys = -9999;  // noData of storeys_above_ground

/// Collects the features of a city, hundreds of thousands, column by column in scratch files.
class FeatureTableWriter {
 public:
  explicit FeatureTableWriter(const std::filesystem::path& path);

  /// Returns the feature's index.
  std::uint32_t add(const SceneFeature& feature);
  std::uint32_t size() const { return count_; }

  /// Appends the columns to `binary` and returns the extension's JSON. `add_view(offset, size)`
  /// must add a bufferView and return its index. size() must be above 0.
  nlohmann::json write(ScratchFile& binary,
                       const std::function<std::size_t(std::uint64_t, std::uint64_t)>& add_view);

 private:
  struct StringColumn {
    explicit StringColumn(const std::filesystem::path& path) : values(path), offsets(path) {}
    void add(std::string_view text);
    ScratchFile values, offsets;
  };
  std::uint32_t count_ = 0;
  StringColumn id_, type_, function_, provenance_;
  ScratchFile height_, storeys_;
  bool any_height_ = false, any_storeys_ = false;
};

/// Returns the bytes of bufferView `index`. Throws Error if there is none.
using ViewBytes = std::function<std::span<const std::byte>(std::size_t index)>;

/// Returns the features in property table `table` of the extension, none if the table is not of our
/// class.
std::vector<SceneFeature> read_feature_table(const nlohmann::json& extension, std::size_t table,
                                             const ViewBytes& view_bytes);

}  // namespace nightcity
