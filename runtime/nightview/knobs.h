// What a sweep may turn: each knob by name, with the values it takes when nobody says otherwise.
#pragma once

#include <string>
#include <vector>

#include "runtime/render/settings.h"

namespace nightcity {

struct Knob {
  const char* name;  // of the option and of the CSV's column
  const char* help;
  std::string defaults;  // comma-separated
  void (*set)(RenderSettings& settings, const Knob& knob,
              const std::string& word);  // throws UsageError
};

/// All of them; a new one is one line in knobs.cpp.
const std::vector<Knob>& knobs();

/// "1,2,4" to words; throws UsageError naming `option` where one is empty.
std::vector<std::string> split_list(const std::string& option, const std::string& text);

/// A word to a number from `least` to `most`; throws UsageError naming `option` where it is none.
std::size_t count_of(const std::string& option, const std::string& word, std::size_t least,
                     std::size_t most);

}  // namespace nightcity
