#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <span>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/exr_info.h"
#include "runtime/measure/limits.h"

namespace nightcity::measure {
namespace {

// OpenEXR writes its line table last, over a placeholder near the start, so the stream must support
// seeking.
class StreamOut : public Imf::OStream {
 public:
  StreamOut(AtomicFile& file, const std::string& name) : OStream(name.c_str()), file_(file) {}
  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (position_ == file_.size()) {
      file_.write(bytes, size);
    } else {
      file_.write_at(position_, bytes, size);
    }
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

 private:
  AtomicFile& file_;
  std::uint64_t position_ = 0;
};

void refuse_non_finite(const std::string& file, const std::string& what,
                       std::span<const float> values, std::size_t channels, std::uint32_t width) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    const std::size_t pixel = i / channels;
    throw Error(file, fmt::format("{}, pixel ({}, {})", what, pixel % width, pixel / width),
                "not a finite number");
  }
}

std::string channel_name(const ImageLayer& layer, const std::string& channel) {
  return layer.name + "." + channel;
}

void check(const std::string& file, const Image& image) {
  if (image.width == 0 || image.height == 0 || image.width > max_image_side ||
      image.height > max_image_side)
    throw Error(file, fmt::format("{} x {} pixels: a side must be 1 to {}", image.width,
                                  image.height, max_image_side));
  if (image.rgb.size() != 3 * image.pixels())
    throw Error(file, "the picture's values do not fit its size");
  refuse_non_finite(file, "picture", image.rgb, 3, image.width);

  std::set<std::string> names;
  for (const ImageLayer& layer : image.layers) {
    const std::string place = "layer \"" + layer.name + "\"";
    if (layer.name.empty() || layer.channels.empty())
      throw Error(file, place, "has no name or no channels");
    for (const std::string& channel : layer.channels) {
      if (channel.empty() || channel.find('.') != std::string::npos)
        throw Error(file, place, "a channel's name must be there and without a dot");
      if (!names.insert(channel_name(layer, channel)).second)
        throw Error(file, place, "occurs twice");
    }
    if (layer.values.size() != image.pixels() * layer.channels.size())
      throw Error(file, place, "its values do not fit the picture's size");
    refuse_non_finite(file, place, layer.values, layer.channels.size(), image.width);
  }
}

// Returns a slice of `channels` interleaved floats per pixel; `first` is pixel (0, 0) of this
// channel.
Imf::Slice slice(const float* first, std::size_t channels, std::size_t row_pixels) {
  return {Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(first)), channels * sizeof(float),
          channels * sizeof(float) * row_pixels};
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Image& image) {
  check(path.string(), image);

  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addWhiteLuminance(header, 1.0f);
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709 with D65
  put_image_info(header, image.info);

  Imf::FrameBuffer frame;
  const auto add = [&](const std::string& name, const float* first, std::size_t channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, slice(first, channels, image.width));
  };
  for (std::size_t i = 0; i < 3; ++i) add(std::string(1, "RGB"[i]), image.rgb.data() + i, 3);
  for (const ImageLayer& layer : image.layers)
    for (std::size_t i = 0; i < layer.channels.size(); ++i)
      add(channel_name(layer, layer.channels[i]), layer.values.data() + i, layer.channels.size());

  AtomicFile atomic(path);
  try {
    StreamOut stream(atomic, path.string());
    Imf::OutputFile file(stream, header, 1);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(image.height));
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(path.string(), error.what());
  }
  atomic.commit();
}

}  // namespace nightcity::measure
