#include "tools/map_lights/sign_tags.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tools/lights/lit_tag.h"
#include "tools/map_lights/thing.h"
#include "tools/osm/bearings.h"
#include "tools/osm/tag_values.h"

namespace nightcity::map_lights {
namespace {

constexpr double min_face_m = 0.2, max_face_m = 30, max_top_m = 100;

class SignReader {
 public:
  SignReader(const osm::OsmTags& tags, const SignDefaults& kind, lights::Half half)
      : tags_(tags), half_(half) {
    sign_.kind = &kind;
    sign_.width_m = kind.width_m;
    sign_.height_m = kind.height_m;
    sign_.foot_m = kind.foot_m;
    sign_.sides = kind.sides;
    sign_.luminous = kind.luminous;
  }

  SignTags read() {
    read_size();
    read_faces();
    read_light();
    return std::move(sign_);
  }

 private:
  std::string find(const char* key) const { return osm::find_raw_tag(tags_, key); }
  void count_unread(const char* key) { ++sign_.unread[std::string(key) + "=" + find(key)]; }

  std::optional<double> read_length(const char* key, double low, double high) {
    const std::string text = find(key);
    if (text.empty()) return std::nullopt;
    const auto length = osm::parse_length_m(text);
    if (length && *length >= low && *length <= high) return length;
    count_unread(key);
    return std::nullopt;
  }

  // Returns width and height from "3.56x2.52" or "3.56 m x 2.52 m".
  void read_both_lengths() {
    std::string text = osm::normalise_tag(find("size"));
    if (text.empty()) return;
    constexpr std::string_view times = "\u00d7";
    if (const std::size_t at = text.find(times); at != text.npos)
      text.replace(at, times.size(), "x");
    const std::size_t cross = text.find('x');
    const auto read = [](std::string part) {
      std::erase(part, '_');
      const auto length = osm::parse_length_m(part);
      return length && *length >= min_face_m && *length <= max_face_m ? length : std::nullopt;
    };
    const auto width = cross == text.npos ? std::nullopt : read(text.substr(0, cross));
    const auto height = cross == text.npos ? std::nullopt : read(text.substr(cross + 1));
    if (!width || !height) return count_unread("size");
    sign_.width_m = *width;
    sign_.height_m = *height;
    sign_.size = ValueSource::tag;
  }

  void read_size() {
    read_both_lengths();
    if (const auto width = read_length("width", min_face_m, max_face_m)) {
      sign_.width_m = *width;
      sign_.size = ValueSource::tag;
    }
    const auto top = read_length("height", 0.3, max_top_m);
    const auto foot = read_length("min_height", 0, max_top_m);
    if (top && foot && *top - *foot >= min_face_m && *top - *foot <= max_face_m) {
      sign_.height_m = *top - *foot;
      sign_.foot_m = *foot;
      sign_.size = ValueSource::tag;
    } else if (top) {
      sign_.height_m = std::max(min_face_m, std::min(sign_.height_m, *top - 0.1));
      sign_.foot_m = std::max(0.05, *top - sign_.height_m);
    } else if (foot) {
      sign_.foot_m = *foot;
    }
  }

  void read_faces() {
    const std::string sides = osm::normalise_tag(find("sides"));
    if (sign_.kind->sides > 0 && !sides.empty()) {
      if (sides == "1" || sides == "2")
        sign_.sides = sides == "1" ? 1 : 2;
      else
        count_unread("sides");
    }
    if (const std::string text = find("direction"); !text.empty()) {
      const osm::Bearings bearings = osm::parse_bearings(text);
      if (!bearings.degrees.empty()) sign_.bearing_degrees = bearings.degrees.front();
      // Two faces that look away from each other are the two sides of one sheet.
      const bool back_to_back =
          bearings.degrees.size() == 2 &&
          std::abs(std::abs(bearings.degrees[0] - bearings.degrees[1]) - 180) < 30;
      if (back_to_back && sides.empty() && sign_.kind->sides > 0) sign_.sides = 2;
      if (!bearings.unread.empty() || bearings.degrees.size() > (back_to_back ? 2u : 1u))
        count_unread("direction");
    }
  }

  void read_light() {
    const std::string luminous = osm::normalise_tag(find("luminous")),
                      animated = osm::normalise_tag(find("animated"));
    // OSM wiki, "Key:animated": what is shown is light.
    if (animated == "digital_display" || animated == "screen") sign_.luminous = true;
    if (luminous == "yes" || luminous == "no") sign_.luminous = luminous == "yes";
    const auto [lit, unread] = lights::read_lit_tags(tags_, "lit", half_);
    for (const std::string& text : unread) ++sign_.unread[text];
    sign_.hours = lit.hours;
    const bool is_lit = lit.kind == lights::LitTag::Kind::lit;
    if (lit.kind == lights::LitTag::Kind::dark && luminous != "yes") {
      sign_.dark = "lit=no";
    } else if (!sign_.luminous && !is_lit) {
      sign_.dark = luminous == "no" ? "luminous=no" : "advertising that no tag says is lit";
    }
    if (luminous == "yes" || is_lit) sign_.shines = ValueSource::tag;
    sign_.luminance_cd_m2 = sign_.luminous ? sign_.kind->luminance_cd_m2 : lit_poster_cd_m2;
  }

  const osm::OsmTags& tags_;
  lights::Half half_;
  SignTags sign_;
};

}  // namespace

SignTags read_sign_tags(const osm::OsmTags& tags, const SignDefaults& kind, lights::Half half) {
  return SignReader(tags, kind, half).read();
}

}  // namespace nightcity::map_lights
