// A service on this machine whose answers a test sets, request by request.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace nightcity::test {

/// Serves one connection at a time on a free port of 127.0.0.1 until destroyed.
class StandIn {
 public:
  struct Reply {
    int status = 200;
    std::string body;
    std::string headers;  // "Retry-After: 1\r\n"
  };
  /// Returns the reply to a request's body; called on the server's thread.
  using Handler = std::function<Reply(const std::string& body)>;

  explicit StandIn(Handler handler) : handler_(std::move(handler)) {
    socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (socket_ < 0 || ::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        ::listen(socket_, 8) != 0 ||
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("no local server");
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~StandIn() {
    ::shutdown(socket_, SHUT_RDWR);
    ::close(socket_);
    thread_.join();
  }

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/api/v1/lookup"; }
  std::vector<std::string> requests() const {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

  /// Returns an answer with a height for each place of a request.
  static Reply heights(const std::string& body,
                       const std::function<nlohmann::json(double lat, double lon)>& of) {
    nlohmann::json results = nlohmann::json::array();
    const auto asked = nlohmann::json::parse(body);  // it lives as long as the loop
    for (const auto& place : asked["locations"]) {
      const double lat = place["latitude"], lon = place["longitude"];
      results.push_back({{"latitude", lat}, {"longitude", lon}, {"elevation", of(lat, lon)}});
    }
    return {200, nlohmann::json{{"results", results}}.dump(), ""};
  }

 private:
  void serve() {
    for (int connection; (connection = ::accept(socket_, nullptr, nullptr)) >= 0;
         ::close(connection)) {
      std::string text;
      std::size_t body = std::string::npos, length = 0;
      char block[65536];
      while (body == std::string::npos || text.size() < body + length) {
        const ssize_t got = ::recv(connection, block, sizeof block, 0);
        if (got <= 0) break;
        text.append(block, static_cast<std::size_t>(got));
        if (body == std::string::npos && (body = text.find("\r\n\r\n")) != std::string::npos) {
          body += 4;
          const std::size_t field = text.find("Content-Length: ");
          if (field != std::string::npos) length = std::stoul(text.substr(field + 16));
        }
      }
      if (body == std::string::npos) continue;
      const std::string request = text.substr(body);
      {
        const std::lock_guard lock(mutex_);
        requests_.push_back(request);
      }
      const Reply reply = handler_(request);
      const std::string answer = "HTTP/1.1 " + std::to_string(reply.status) +
                                 " x\r\nContent-Length: " + std::to_string(reply.body.size()) +
                                 "\r\n" + reply.headers + "Connection: close\r\n\r\n" + reply.body;
      [[maybe_unused]] const auto sent =
          ::send(connection, answer.data(), answer.size(), MSG_NOSIGNAL);
    }
  }

  Handler handler_;
  int socket_ = -1;
  unsigned port_ = 0;
  mutable std::mutex mutex_;
  std::vector<std::string> requests_;
  std::thread thread_;
};

}  // namespace nightcity::test
