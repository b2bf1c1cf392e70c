#include "runtime/measure/png.h"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstring>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/mapped_file.h"
#include "runtime/measure/limits.h"

namespace nightcity::measure {
namespace {

// libpng reports errors by longjmp, which skips destructors. So everything with a destructor lives
// in this struct, outside the function that calls setjmp.
struct PngWrite {
  std::string bytes;
  std::string error;
  std::vector<png_text_struct> text;
  std::vector<png_bytep> rows;
  png_structp png = nullptr;
  png_infop info = nullptr;

  PngWrite() = default;
  PngWrite(const PngWrite&) = delete;
  PngWrite& operator=(const PngWrite&) = delete;
  ~PngWrite() { png_destroy_write_struct(&png, &info); }
};

void keep_error(png_structp png, png_const_charp message) {
  static_cast<PngWrite*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void keep_silent(png_structp, png_const_charp) {}

void append_bytes(png_structp png, png_bytep data, std::size_t size) {
  static_cast<PngWrite*>(png_get_io_ptr(png))
      ->bytes.append(reinterpret_cast<const char*>(data), size);
}

bool encode(PngWrite& write, const Image8& image) {
  if (setjmp(png_jmpbuf(write.png))) return false;
  png_set_write_fn(write.png, &write, append_bytes, nullptr);
  png_set_IHDR(write.png, write.info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(write.png, write.info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (!write.text.empty())
    png_set_text(write.png, write.info, write.text.data(), static_cast<int>(write.text.size()));
  png_set_rows(write.png, write.info, write.rows.data());
  png_write_png(write.png, write.info, PNG_TRANSFORM_IDENTITY, nullptr);
  return true;
}

void check_size(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0 || width > max_image_side || height > max_image_side)
    throw Error(path.string(), fmt::format("{} x {} pixels: a side must be 1 to {}", width, height,
                                           max_image_side));
}

}  // namespace

PngText png_text(const ImageInfo& info) {
  PngText text{{"Software", "nightview"}};
  if (!info.estimator.empty()) text.emplace_back("Estimator", info.estimator);
  if (info.frames) text.emplace_back("Frames", std::to_string(info.frames));
  if (info.candidates) text.emplace_back("Candidates", std::to_string(info.candidates));
  if (info.neighbours) text.emplace_back("Neighbours", std::to_string(info.neighbours));
  if (info.bounces) text.emplace_back("Bounces", std::to_string(info.bounces));
  if (!info.indirect.empty()) text.emplace_back("Indirect light", info.indirect);
  if (!info.left_out.empty()) text.emplace_back("Left out", info.left_out);
  if (!info.settings.empty()) text.emplace_back("Settings", info.settings);
  if (!info.estimator.empty()) text.emplace_back("Seed", std::to_string(info.seed));
  if (info.ev100) text.emplace_back("EV100", fmt::format("{:.3f}", *info.ev100));
  if (!info.eye.empty()) text.emplace_back("Shown with", info.eye);
  if (!info.device.empty()) text.emplace_back("Device", info.device);
  if (!info.licences.empty()) text.emplace_back("Copyright", info.licences);
  if (!info.camera.empty()) text.emplace_back("Camera", info.camera);
  if (!info.time.empty()) text.emplace_back("Time", info.time);
  return text;
}

void write_png(const std::filesystem::path& path, const Image8& image, const PngText& text) {
  check_size(path, image.width, image.height);
  if (image.rgb.size() != std::size_t{3} * image.width * image.height)
    throw Error(path.string(), "the picture's bytes do not fit its size");

  PngWrite write;
  write.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &write, keep_error, keep_silent);
  if (write.png) write.info = png_create_info_struct(write.png);
  if (!write.info) throw Error(path.string(), "libpng found no memory");
  for (const auto& [keyword, value] : text) {
    png_text_struct entry{};
    entry.compression = PNG_TEXT_COMPRESSION_NONE;
    entry.key = const_cast<char*>(keyword.c_str());  // libpng only reads them
    entry.text = const_cast<char*>(value.c_str());
    entry.text_length = value.size();
    write.text.push_back(entry);
  }
  for (std::uint32_t y = 0; y < image.height; ++y)
    write.rows.push_back(const_cast<png_bytep>(&image.rgb[std::size_t{3} * image.width * y]));
  if (!encode(write, image)) throw Error(path.string(), "PNG: " + write.error);

  AtomicFile file(path);
  file.write(write.bytes);
  file.commit();
}

Image8 read_png(const std::filesystem::path& path) {
  const MappedFile file(path);
  struct Reading : png_image {
    Reading() : png_image{} { version = PNG_IMAGE_VERSION; }
    ~Reading() { png_image_free(this); }
  } reading;
  if (!png_image_begin_read_from_memory(&reading, file.bytes().data(), file.bytes().size()))
    throw Error(path.string(), std::string("PNG: ") + reading.message);
  check_size(path, reading.width, reading.height);
  // Deflate compresses by a factor of 1032 at most, so a short file cannot claim gigabytes.
  if (std::size_t{reading.width} * reading.height / 8 > file.bytes().size() * 1032)
    throw Error(path.string(), "PNG: too short for the size it names");

  reading.format = PNG_FORMAT_RGB;
  Image8 image{reading.width, reading.height, {}};
  image.rgb.resize(PNG_IMAGE_SIZE(reading));
  const png_color black{};
  if (!png_image_finish_read(&reading, &black, image.rgb.data(), 0, nullptr))
    throw Error(path.string(), std::string("PNG: ") + reading.message);
  return image;
}

}  // namespace nightcity::measure
