// The error type of both programs: what went wrong, in which file, on which line.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nightcity {

/// The exit codes of both programs; --help and the README document them.
enum class ExitCode : int {
  ok = 0,
  bad_data = 1,   // an input is missing, broken or unusable, or an output cannot be written
  bad_usage = 2,  // the command line or a recipe's keys are wrong
};

/// Thrown for everything that a user can repair. what() is one line in the form of compilers'
/// messages, so that editors and terminals can jump to the place:
///   FILE:LINE: MESSAGE
///   FILE: PLACE: MESSAGE  where the file has no lines; PLACE is "byte 4096", "mesh 3", "[osm]
/// files[0]"
///   FILE: MESSAGE         where neither is known
/// An empty FILE or PLACE is left out with its colon.
class Error : public std::runtime_error {
 public:
  Error(std::string_view file, std::string_view message) : Error(file, std::size_t{0}, message) {}
  /// `line` counts from 1; 0 = not known.
  Error(std::string_view file, std::size_t line, std::string_view message)
      : std::runtime_error(to_text(file, line, {}, message)), line_(line) {}
  Error(std::string_view file, std::string_view place, std::string_view message)
      : std::runtime_error(to_text(file, 0, place, message)) {}

  /// Returns the line in the file, from 1, or 0 where none is known.
  std::size_t line() const noexcept { return line_; }
  virtual ExitCode exit_code() const noexcept { return ExitCode::bad_data; }

 private:
  static std::string to_text(std::string_view file, std::size_t line, std::string_view place,
                             std::string_view message) {
    std::string text(file);
    if (line != 0) text += (text.empty() ? "line " : ":") + std::to_string(line);
    if (!text.empty()) text += ": ";
    if (!place.empty()) text.append(place).append(": ");
    return text.append(message);
  }

  std::size_t line_ = 0;
};

/// A command line or a recipe that asks for something impossible.
class UsageError : public Error {
 public:
  using Error::Error;
  ExitCode exit_code() const noexcept override { return ExitCode::bad_usage; }
};

}  // namespace nightcity
