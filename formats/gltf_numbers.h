// Arrays of numbers in glTF's JSON.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/gltf_document.h"

namespace nightcity::gltf {

/// Returns a member that is an array of as many numbers as `defaults`, or these if it is absent.
/// Throws Error, without a file name, if it is anything else.
inline std::vector<double> numbers(const Json& object, const char* key,
                                   std::vector<double> defaults) {
  const Json& array = member(object, key);
  if (array.is_null()) return defaults;
  const bool right =
      array.is_array() && array.size() == defaults.size() &&
      std::all_of(array.begin(), array.end(), [](const Json& v) { return v.is_number(); });
  if (!right) throw Error("", key, "is not " + std::to_string(defaults.size()) + " numbers");
  return array.get<std::vector<double>>();
}

}  // namespace nightcity::gltf
