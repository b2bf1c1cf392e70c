// The message of the error that an action ends by.
#pragma once

#include <string>

#include "formats/error.h"

namespace nightcity::test {

/// Returns what the Error says that `action` throws, `otherwise` where it throws none.
template <class Action>
std::string message_of(const Action& action, const std::string& otherwise = "") {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return otherwise;
}

}  // namespace nightcity::test
