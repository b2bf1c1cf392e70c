// Reads an OBJ from its text.
#pragma once

#include <string>

#include "formats/error.h"
#include "tests/tools/city/read_city.h"
#include "tests/tools/citygml/temporary_file.h"
#include "tools/obj/read_obj.h"

namespace nightcity::test {

inline City read_obj_file(const std::filesystem::path& file,
                          const city::ReadOptions& options = {}) {
  City city;
  const city::ObjectSink sink = city.sink();
  city.report = obj::read_obj_staged(file, options, city::deliver_to(sink));
  return city;
}

inline City read_obj_text(const std::string& text, const city::ReadOptions& options = {}) {
  return read_obj_file(TemporaryFile(text, ".obj").path(), options);
}

inline city::ReadOptions with_up(city::MeshPlacement::Up up) {
  city::ReadOptions options;
  options.mesh.up = up;
  return options;
}

/// Returns the message of the Error, "read" where there is none.
inline std::string error_of_obj(const std::string& text, const city::ReadOptions& options = {}) {
  try {
    read_obj_text(text, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "read";
}

}  // namespace nightcity::test
