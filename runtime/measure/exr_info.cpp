#include "runtime/measure/exr_info.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <charconv>
#include <cmath>

namespace nightcity::measure {

// Whole numbers are stored as text, because OpenEXR's only integer attribute has 32 bits with a
// sign: too few for a seed.
void put_image_info(Imf::Header& header, const ImageInfo& info) {
  const auto text = [&](const char* name, const std::string& value) {
    if (!value.empty()) header.insert(name, Imf::StringAttribute(value));
  };
  const auto number = [&](const char* name, std::uint64_t value) {
    if (value) text(name, std::to_string(value));
  };
  text("nightcity.estimator", info.estimator);
  number("nightcity.frames", info.frames);
  number("nightcity.candidates", info.candidates);
  number("nightcity.neighbours", info.neighbours);
  number("nightcity.bounces", info.bounces);
  text("nightcity.indirect", info.indirect);
  text("nightcity.left_out", info.left_out);
  text("nightcity.settings", info.settings);
  number("nightcity.seed", info.seed);
  text("nightcity.device", info.device);
  text("nightcity.licences", info.licences);
  text("nightcity.camera", info.camera);
  text("nightcity.time", info.time);
  if (info.ev100) header.insert("nightcity.ev100", Imf::FloatAttribute(*info.ev100));
}

ImageInfo get_image_info(const Imf::Header& header) {
  const auto text = [&](const char* name) {
    const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
    return attribute ? attribute->value() : std::string();
  };
  const auto number = [&]<typename T>(const char* name, T& target) {
    const std::string value = text(name);
    T parsed{};
    if (std::from_chars(value.data(), value.data() + value.size(), parsed).ec == std::errc{})
      target = parsed;
  };
  ImageInfo info;
  info.estimator = text("nightcity.estimator");
  number("nightcity.frames", info.frames);
  number("nightcity.candidates", info.candidates);
  number("nightcity.neighbours", info.neighbours);
  number("nightcity.bounces", info.bounces);
  info.indirect = text("nightcity.indirect");
  info.left_out = text("nightcity.left_out");
  info.settings = text("nightcity.settings");
  number("nightcity.seed", info.seed);
  info.device = text("nightcity.device");
  info.licences = text("nightcity.licences");
  info.camera = text("nightcity.camera");
  info.time = text("nightcity.time");
  if (const auto* ev100 = header.findTypedAttribute<Imf::FloatAttribute>("nightcity.ev100"))
    if (std::isfinite(ev100->value())) info.ev100 = ev100->value();
  return info;
}

}  // namespace nightcity::measure
