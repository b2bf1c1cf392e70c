// A large JSON document written out piece by piece: as a whole, in memory, it would be many times its size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/atomic_file.h"

namespace nightcity {

// CityGML ids may hold bytes that are no UTF-8; JSON may not.
inline std::string dump(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

// A JSON array kept as text, on disk: a large city has a hundred thousand accessors.
class JsonArray {
 public:
  explicit JsonArray(const std::filesystem::path& path) : text_(path) {}

  std::size_t add(const nlohmann::json& element) {
    if (count_ != 0) text_.write(",", 1);
    const std::string text = dump(element);
    text_.write(text.data(), text.size());
    return count_++;
  }
  std::size_t count() const { return count_; }
  ScratchFile& text() { return text_; }

 private:
  ScratchFile text_;
  std::size_t count_ = 0;
};

// The JSON chunk while it is put together, of texts and of arrays that lie on disk.
class JsonText {
 public:
  void add(std::string_view text) {
    parts_.emplace_back(text, nullptr);
    size_ += text.size();
  }
  void add(JsonArray& array) {
    add("[");
    parts_.emplace_back("", &array.text());
    size_ += array.text().size();
    add("]");
  }
  std::uint64_t size() const { return size_; }
  void write(AtomicFile& file) const {
    for (const auto& [text, array] : parts_) {
      file.write(text);
      if (array) array->copy_to(file);
    }
  }

 private:
  std::vector<std::pair<std::string, ScratchFile*>> parts_;
  std::uint64_t size_ = 0;
};

}  // namespace nightcity
