// The body of the fuzz targets of city files: any bytes are read, and what comes is triangulated.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "formats/error.h"
#include "formats/finite.h"
#include "tests/tools/city/sound_picture.h"
#include "tests/tools/citygml/memory_document.h"
#include "tools/city/city_reader.h"
#include "tools/mesh/classify.h"
#include "tools/mesh/close_gaps.h"
#include "tools/mesh/triangulate.h"

namespace nightcity::test {

/// Calls `read(document, options, stage)` on the bytes. Aborts on a position that is no number and
/// on a picture that does not fit its polygon; an Error is what a broken document deserves.
template <class Read>
void fuzz_city(const std::uint8_t* data, std::size_t size, const Read& read) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  city::ReadOptions options;
  options.threads = 1;
  mesh::MeshReport report;
  const city::ObjectSink sink = [&](city::CityObject&& object) {
    for (const city::Polygon& polygon : object.polygons)
      if (!has_sound_picture(polygon)) std::abort();
    mesh::repair_shells(object, report);
    mesh::classify_unknown_surfaces(object);
    for (const glm::dvec3& p : mesh::triangulate(object, report).positions)
      if (!finite(p)) std::abort();
  };
  try {
    read(memory_document(text), options, city::deliver_to(sink));
  } catch (const Error&) {
  }
}

}  // namespace nightcity::test
