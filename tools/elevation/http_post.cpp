#include "tools/elevation/http_post.h"

#include <curl/curl.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <mutex>
#include <string_view>

#include "formats/error.h"

namespace nightcity::elevation {
namespace {

constexpr std::size_t max_answer_bytes = 64u << 20;

std::size_t take_body(char* data, std::size_t size, std::size_t count, void* user) {
  std::string& body = static_cast<HttpAnswer*>(user)->body;
  if (body.size() + size * count > max_answer_bytes) return 0;  // ends the transfer
  body.append(data, size * count);
  return size * count;
}

std::size_t take_header(char* data, std::size_t size, std::size_t count, void* user) {
  std::string_view line(data, size * count);
  constexpr std::string_view name = "retry-after:";
  const bool ours = line.size() > name.size() &&
                    std::equal(name.begin(), name.end(), line.begin(), [](char wanted, char c) {
                      return wanted == std::tolower(static_cast<unsigned char>(c));
                    });
  if (ours) {
    line.remove_prefix(name.size());
    while (line.starts_with(' ')) line.remove_prefix(1);
    long seconds = 0;  // a date instead of seconds is ignored
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), seconds);
    if (error == std::errc() && seconds >= 0 && end != line.data())
      static_cast<HttpAnswer*>(user)->retry_after_s = seconds;
  }
  return size * count;
}

}  // namespace

struct HttpClient::State {
  CURL* curl = nullptr;
  curl_slist* headers = nullptr;
};

HttpClient::HttpClient() : state_(std::make_unique<State>()) {
  static std::once_flag once;
  std::call_once(once, [] { curl_global_init(CURL_GLOBAL_DEFAULT); });
  state_->curl = curl_easy_init();
  state_->headers = curl_slist_append(nullptr, "Content-Type: application/json");
  if (!state_->curl || !state_->headers) throw Error("", "libcurl cannot start");
}

HttpClient::~HttpClient() {
  curl_slist_free_all(state_->headers);
  if (state_->curl) curl_easy_cleanup(state_->curl);
}

HttpAnswer HttpClient::post_json(const std::string& url, const std::string& body) {
  CURL* curl = state_->curl;
  HttpAnswer answer;
  char reason[CURL_ERROR_SIZE] = "";
  curl_easy_setopt(curl, CURLOPT_URL, url.c_str());
  curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(curl, CURLOPT_HTTPHEADER, state_->headers);
  curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(body.size()));
  curl_easy_setopt(curl, CURLOPT_POSTFIELDS, body.c_str());
  curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, take_body);
  curl_easy_setopt(curl, CURLOPT_WRITEDATA, &answer);
  curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, take_header);
  curl_easy_setopt(curl, CURLOPT_HEADERDATA, &answer);
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, reason);
  curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, 15L);
  curl_easy_setopt(curl, CURLOPT_TIMEOUT, 60L);
  curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl, CURLOPT_USERAGENT, "nightbake");
  const CURLcode code = curl_easy_perform(curl);
  curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, nullptr);
  if (code != CURLE_OK)
    throw Error(url,
                "cannot be asked: " + std::string(*reason ? reason : curl_easy_strerror(code)));
  curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &answer.status);
  return answer;
}

}  // namespace nightcity::elevation
