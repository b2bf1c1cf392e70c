// libFuzzer target: reads any bytes as an OBJ with a library of colours and a picture (bundle.h),
// lays the picture on the faces, and triangulates.
#include <cstddef>
#include <span>

#include "formats/error.h"
#include "formats/mapped_file.h"
#include "formats/picture_mean.h"
#include "tests/tools/city/fuzz_city.h"
#include "tests/tools/obj/bundle.h"
#include "tools/obj/read_obj.h"

namespace {

// A header of a few bytes may ask for seconds of work on a cut picture.
bool is_large(const std::filesystem::path& file) {
  constexpr std::int64_t max_pixels = 1 << 16;
  try {
    const nightcity::MappedFile mapped(file);
    return nightcity::count_picture_pixels(mapped.bytes()).value_or(0) > max_pixels;
  } catch (const nightcity::Error&) {
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  static const test::TempFolder folder;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = test::write_bundle(folder, text);
  if (is_large(folder / "p.png")) return 0;
  test::fuzz_city(data, size, [&](const auto&, city::ReadOptions options, const auto& stage) {
    options.textures = city::Textures::atlas;
    obj::read_obj_staged(file, options, stage);
  });
  return 0;
}
