#include "formats/program/print_json.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace nightcity::program {
namespace {

template <typename Json>
std::string dump(const Json& value) {
  return value.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string to_json_text(const nlohmann::json& value) {
  return dump(value);
}
std::string to_json_text(const nlohmann::ordered_json& value) {
  return dump(value);
}
void print_json(const nlohmann::json& value) {
  fmt::print("{}\n", dump(value));
}
void print_json(const nlohmann::ordered_json& value) {
  fmt::print("{}\n", dump(value));
}

}  // namespace nightcity::program
