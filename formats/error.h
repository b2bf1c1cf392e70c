// The one error type of the house: what went wrong, in which file, at which place in it.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace nightcity {

// Exit codes of both programs; documented in --help and README.
enum class ExitCode : int {
  ok = 0,
  bad_data = 1,   // an input is missing, broken or cannot be used; an output cannot be written
  bad_usage = 2,  // the command line or a recipe's keys are wrong
};

/// Thrown for anything a user can mend. what() is one line: "FILE:PLACE: MESSAGE".
/// FILE and PLACE ("line 12", "byte 4096", "[osm] files[0]") are left out where there is none.
class Error : public std::runtime_error {
 public:
  Error(std::string_view file, std::string_view place, std::string_view message)
      : std::runtime_error(one_line(file, place, message)) {}
  Error(std::string_view file, std::string_view message) : Error(file, {}, message) {}

  virtual ExitCode exit_code() const noexcept { return ExitCode::bad_data; }

 private:
  static std::string one_line(std::string_view file, std::string_view place,
                              std::string_view message) {
    std::string text(file);
    if (!place.empty()) {
      if (!text.empty()) text += ": ";
      text += place;
    }
    if (!text.empty()) text += ": ";
    text += message;
    return text;
  }
};

/// A command line or recipe that asks for something impossible.
class UsageError : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::bad_usage; }
};

}  // namespace nightcity
