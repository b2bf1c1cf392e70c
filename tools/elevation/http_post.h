// HTTP requests with JSON in their body.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace nightcity::elevation {

struct HttpAnswer {
  long status = 0;
  std::string body;
  std::optional<long> retry_after_s;
};

/// A connection that is kept between requests to one server.
class HttpClient {
 public:
  HttpClient();
  ~HttpClient();
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  /// Sends `body` and returns the answer, also one whose status is no success. Throws Error (named
  /// `url`) where no answer comes within a minute or it is over 64 MB.
  HttpAnswer post_json(const std::string& url, const std::string& body);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity::elevation
