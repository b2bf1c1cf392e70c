// libFuzzer target: reads any bytes as a light file. Its checksums are corrected first, because
// otherwise hardly any input would get past them.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/light_file.h"
#include "support/fuzz_file.h"
#include "tests/formats/light_file_checksums.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  std::vector<std::uint8_t> bytes(data, data + size);
  test::fix_checksums(bytes);
  const test::FuzzFile file(bytes.data(), bytes.size());
  try {
    const LightFile lights = LightFile::open(file.path());
    lights.verify();
    if (lights.provenance().size() != lights.lights().size()) std::abort();
    for (const Light& light : lights.lights())
      if (!(light.flux_lm > 0) || !finite(light.position)) std::abort();
    for (const LightProfile& profile : lights.profiles())
      if (profile.data_offset + std::uint64_t{profile.c_count} * profile.gamma_count >
          lights.profile_data().size())
        std::abort();
  } catch (const Error&) {  // a broken file is refused
  }
  return 0;
}
