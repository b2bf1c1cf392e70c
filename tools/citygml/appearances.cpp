#include "tools/citygml/appearances.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "tools/city/attributes.h"
#include "tools/citygml/picture_colours.h"
#include "tools/citygml/rings.h"
#include "tools/citygml/tag_scanner.h"

namespace nightcity::citygml {
namespace {

constexpr std::size_t max_targets = 2'000'000;  // 100 MB

std::size_t hash(std::string_view id) {
  return std::hash<std::string_view>()(id);
}

}  // namespace

void Materials::read(const pugi::xml_node& appearance, city::SkipCounter& skipped) {
  read_below(appearance, 0, skipped);
}

void Materials::read_below(const pugi::xml_node& element, int depth, city::SkipCounter& skipped) {
  constexpr int max_depth = 8;  // member, Appearance, surfaceDataMember
  for (const pugi::xml_node& child : element.children()) {
    const std::string_view name = local_name(child.name());
    if (depth < max_depth &&
        (name == "Appearance" || name == "surfaceDataMember" || name == "surfaceData")) {
      read_below(child, depth + 1, skipped);
    } else if (name == "X3DMaterial") {
      glm::vec3 colour{0.8f};  // X3D's own default
      std::vector<double> numbers;
      std::vector<std::string_view> targets;
      bool front = true;
      for (const pugi::xml_node& property : child.children()) {
        const std::string_view kind = local_name(property.name());
        if (kind == "diffuseColor" && read_numbers(property, numbers) && numbers.size() == 3)
          colour = {std::clamp(static_cast<float>(numbers[0]), 0.0f, 1.0f),
                    std::clamp(static_cast<float>(numbers[1]), 0.0f, 1.0f),
                    std::clamp(static_cast<float>(numbers[2]), 0.0f, 1.0f)};
        else if (kind == "target")
          targets.push_back(city::trim(property.child_value()));
        else if (kind == "isFront")
          front = city::trim(property.child_value()) != "false" &&
                  city::trim(property.child_value()) != "0";
      }
      for (const std::string_view target : targets) {
        if (!front || !target.starts_with('#')) continue;
        if (colours_.size() < max_targets)
          colours_.emplace(hash(target.substr(1)), colour);
        else
          skipped.add("app:target: beyond the two million whose colours are kept");
      }
    } else if (name == "ParameterizedTexture" && pictures_) {
      read_texture(child, skipped);
    } else if (child.type() == pugi::node_element && name != "theme") {
      skipped.add(child.name());
    }
  }
}

void Materials::read_texture(const pugi::xml_node& texture, city::SkipCounter& skipped) {
  const auto take_colour = [&](std::string_view id, const glm::vec3& colour) {
    if (colours_.size() < max_targets)
      colours_.insert_or_assign(hash(id), colour);
    else
      skipped.add("app:target: beyond the two million whose colours are kept");
  };
  const auto take_ring = [&](std::string_view id, RingTexture&& ring) {
    if (rings_.size() < max_targets) rings_.insert_or_assign(hash(id), std::move(ring));
  };
  pictures_->read(texture, skipped, take_colour, take_ring);
}

const RingTexture* Materials::find_ring(std::string_view id) const {
  const auto at = rings_.find(hash(id));
  return at == rings_.end() ? nullptr : &at->second;
}

const glm::vec3* Materials::find(std::string_view id) const {
  const auto at = colours_.find(hash(id));
  return at == colours_.end() ? nullptr : &at->second;
}

}  // namespace nightcity::citygml
