// The message of the error that an action ends by.
#pragma once

#include <string>

#include "formats/error.h"

namespace nightcity::test {

/// Returns what the Error says that `action` throws, "" where it throws none.
template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace nightcity::test
