// A large JSON document written piece by piece. As a whole, in memory, it would be many times its
// size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/scratch_file.h"

namespace nightcity {

/// Returns `value` on one line. Bytes that are no UTF-8 (CityGML ids may hold them) become U+FFFD.
std::string dump(const nlohmann::json& value);

/// A JSON array kept as text in a scratch file beside `path`: a large city has a hundred thousand
/// accessors.
class JsonArray {
 public:
  explicit JsonArray(const std::filesystem::path& path) : text_(path) {}

  /// Returns the element's index.
  std::size_t add(const nlohmann::json& element);
  std::size_t count() const { return count_; }
  ScratchFile& text() { return text_; }

 private:
  ScratchFile text_;
  std::size_t count_ = 0;
};

/// JSON text made of strings and of arrays that lie in scratch files. Refers to the arrays.
class JsonText {
 public:
  void add(std::string_view text);
  void add(JsonArray& array);
  std::uint64_t size() const { return size_; }  // bytes
  void write(AtomicFile& file) const;

 private:
  std::vector<std::pair<std::string, ScratchFile*>> parts_;
  std::uint64_t size_ = 0;
};

/// Adds an object to a text, member by member. Keys are written as they are, so they may hold no
/// quotes.
class JsonObject {
 public:
  explicit JsonObject(JsonText& text);
  void add(std::string_view key, const nlohmann::json& value);
  void add(std::string_view key, JsonArray& elements);
  /// Begins an object as a member of this one, to be ended before anything is added to this one.
  JsonObject add_object(std::string_view key);
  void end();

 private:
  void add_key(std::string_view key);

  JsonText& text_;
  bool is_empty_ = true;
};

}  // namespace nightcity
