#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <span>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/exr_claims.h"
#include "runtime/measure/exr_info.h"

namespace nightcity::measure {
namespace {

class StreamIn : public Imf::IStream {
 public:
  StreamIn(std::span<const std::byte> bytes, const std::string& name)
      : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char target[], int count) override {
    const auto size = static_cast<std::uint64_t>(count);
    if (count < 0 || position_ > bytes_.size() || size > bytes_.size() - position_)
      throw Error({}, fmt::format("byte {}", position_), "the file ends too early");
    std::memcpy(target, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t position_ = 0;
};

// The place of one channel of the file: an array of the image, and an offset within each pixel.
struct Target {
  std::string name;
  std::vector<float>* values;
  std::size_t channels;
  std::size_t offset;
};

// The image's arrays for a file's channels. They grow line by line.
std::vector<Target> targets_of(const Imf::ChannelList& channels, Image& image) {
  std::map<std::string, std::vector<std::string>> layers;  // layer -> its channels
  bool has_y = false;
  std::set<std::string> colours;
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
      throw Error({}, std::string("channel \"") + it.name() + "\"", "is not at full resolution");
    const std::string name = it.name();
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos && dot > 0 && dot + 1 < name.size()) {
      layers[name.substr(0, dot)].push_back(name.substr(dot + 1));
    } else if (name == "R" || name == "G" || name == "B") {
      colours.insert(name);
    } else if (name == "Y") {
      has_y = true;
    }
  }

  std::vector<Target> targets;
  if (colours.size() == 3) {
    for (std::size_t i = 0; i < 3; ++i)
      targets.push_back({std::string(1, "RGB"[i]), &image.rgb, 3, i});
  } else if (colours.empty() && has_y) {
    targets.push_back({"Y", &image.rgb, 3, 0});
  } else {
    throw Error({}, "holds neither R, G and B nor Y");
  }
  image.layers.reserve(layers.size());  // targets point into it
  for (auto& [name, names] : layers) {
    ImageLayer& layer = image.layers.emplace_back(ImageLayer{name, std::move(names), {}});
    for (std::size_t i = 0; i < layer.channels.size(); ++i)
      targets.push_back(
          {layer.name + "." + layer.channels[i], &layer.values, layer.channels.size(), i});
  }
  return targets;
}

// Reads one line at a time, each into newly allocated memory: a short file that claims a huge size
// fails early.
void read_lines(Imf::InputFile& file, const std::vector<Target>& targets,
                const Imath::Box2i& window, std::uint32_t width) {
  std::vector<std::vector<float>> lines(targets.size(), std::vector<float>(width));
  Imf::FrameBuffer frame;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    // yStride 0: every line lands in the same row. OpenEXR adds x * stride itself, so step back to
    // x = 0.
    auto* base = reinterpret_cast<char*>(lines[t].data()) - std::ptrdiff_t{window.min.x} * 4;
    frame.insert(targets[t].name, Imf::Slice(Imf::FLOAT, base, sizeof(float), 0));
  }
  file.setFrameBuffer(frame);
  for (int y = window.min.y; y <= window.max.y; ++y) {
    file.readPixels(y);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const Target& target = targets[t];
      if (target.offset == 0)
        target.values->resize(target.values->size() + target.channels * width);
      float* row = target.values->data() + target.values->size() - target.channels * width;
      for (std::size_t x = 0; x < width; ++x)
        row[x * target.channels + target.offset] = lines[t][x];
    }
  }
}

Image read_stream(Imf::IStream& stream) {
  Imf::InputFile file(stream, 1);
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();  // its sides are in bounds
  Image image;
  image.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
  image.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
  const std::vector<Target> targets = targets_of(header.channels(), image);
  read_lines(file, targets, window, image.width);

  if (targets.front().name == "Y")
    for (std::size_t i = 0; i < image.pixels(); ++i)
      image.rgb[3 * i + 1] = image.rgb[3 * i + 2] = image.rgb[3 * i];
  if (Imf::hasWhiteLuminance(header)) {
    const float white = Imf::whiteLuminance(header);
    if (white > 0.0f && std::isfinite(white) && white != 1.0f)
      for (float& value : image.rgb) value *= white;
  }
  image.info = get_image_info(header);
  return image;
}

}  // namespace

Image read_exr(const std::filesystem::path& path) {
  const MappedFile file(path);
  StreamIn stream(file.bytes(), path.string());
  try {
    refuse_false_claims(file.bytes(), stream);
    return read_stream(stream);
  } catch (const Error& error) {
    throw Error(path.string(), error.what());
  } catch (const std::exception& error) {  // of Iex, or bad_alloc
    throw Error(path.string(), std::string("OpenEXR: ") + error.what());
  }
}

}  // namespace nightcity::measure
