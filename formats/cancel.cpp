#include "formats/cancel.h"

#include <utility>

namespace nightcity {
namespace {

thread_local std::stop_token token_of_thread;

}  // namespace

CancelScope::CancelScope(std::stop_token token)
    : before_(std::exchange(token_of_thread, std::move(token))) {}

CancelScope::~CancelScope() {
  token_of_thread = std::move(before_);
}

std::stop_token find_cancel_token() {
  return token_of_thread;
}

void throw_if_cancelled() {
  if (token_of_thread.stop_requested()) throw Cancelled();
}

}  // namespace nightcity
