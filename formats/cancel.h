// Ends work that nobody waits for any more.
#pragma once

#include <exception>
#include <stop_token>

namespace nightcity {

/// Thrown where work ends because it was told to. It is no Error: nothing is to be said about it.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// Lets a token end what this thread does as long as the object lives, and what other threads do
/// for it in run_parallel: each checks before it takes the next piece of work. Scopes may be
/// nested; the innermost counts.
class CancelScope {
 public:
  explicit CancelScope(std::stop_token token);
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  std::stop_token before_;
};

/// Returns the token of this thread's innermost scope: one that never asks for an end without any.
std::stop_token find_cancel_token();

/// Throws Cancelled where that token asks for it.
void throw_if_cancelled();

}  // namespace nightcity
