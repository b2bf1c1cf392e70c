#include "formats/json_text.h"

#include <nlohmann/json.hpp>

namespace nightcity {

std::string dump(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::size_t JsonArray::add(const nlohmann::json& element) {
  if (count_ != 0) text_.write(",", 1);
  const std::string text = dump(element);
  text_.write(text.data(), text.size());
  return count_++;
}

void JsonText::add(std::string_view text) {
  parts_.emplace_back(text, nullptr);
  size_ += text.size();
}

void JsonText::add(JsonArray& array) {
  add("[");
  parts_.emplace_back("", &array.text());
  size_ += array.text().size();
  add("]");
}

void JsonText::write(AtomicFile& file) const {
  for (const auto& [text, array] : parts_) {
    file.write(text);
    if (array) array->copy_to(file);
  }
}

JsonObject::JsonObject(JsonText& text) : text_(text) {
  text_.add("{");
}

void JsonObject::add(std::string_view key, const nlohmann::json& value) {
  add_key(key);
  text_.add(dump(value));
}

void JsonObject::add(std::string_view key, JsonArray& elements) {
  add_key(key);
  text_.add(elements);
}

JsonObject JsonObject::add_object(std::string_view key) {
  add_key(key);
  return JsonObject(text_);
}

void JsonObject::end() {
  text_.add("}");
}

void JsonObject::add_key(std::string_view key) {
  text_.add(is_empty_ ? "\"" : ",\"");
  text_.add(key);
  text_.add("\":");
  is_empty_ = false;
}

}  // namespace nightcity
