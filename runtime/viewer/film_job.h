// A film that a second nightview records, beside the window.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "formats/program/child_program.h"
#include "runtime/viewer/film_command.h"

namespace nightcity::viewer {

class FilmJob {
 public:
  /// Starts it, or goes on with it where pictures are there. Throws Error where that fails.
  FilmJob(const FilmPlace& place, std::uint32_t pictures, double now_s);

  /// Looks how far it is, and returns whether it has ended. Does not wait.
  bool has_ended(double now_s);
  /// Returns "filming: picture 12 of 250, 4 min left (Esc stops)".
  std::string progress(double now_s) const;
  /// Stops it. What is there stays, and the same film goes on from there. Returns the sentence that
  /// says so.
  std::string stop();
  /// Returns the sentence that says where the film is, after has_ended(). Throws Error where there
  /// is none, with the reason.
  std::string result() const;

 private:
  FilmPlace place_;
  std::uint32_t pictures_, begun_with_, done_;
  double start_s_, first_s_ = 0;  // first_s_: when the first picture of this run was there
  int status_ = 0;                // as waitpid's, once it has ended
  program::ChildProgram child_;
};

}  // namespace nightcity::viewer
