// Values as bytes, and back: what one run of a program keeps for another run of the same program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "formats/error.h"

namespace nightcity {

/// Appends values to `bytes`. A struct that holds strings, vectors or maps has a function `template
/// <class Archive> void visit(Archive& archive)` that passes each of its fields to `archive`.
class Packer {
 public:
  explicit Packer(std::string& bytes) : bytes_(bytes) {}

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  template <class T>
  void put(const T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      append(&value, sizeof value);
    else
      const_cast<T&>(value).visit(*this);  // which only reads here
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    append(text.data(), text.size());
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(std::uint64_t{values.size()});
    if constexpr (std::is_trivially_copyable_v<T>)
      append(values.data(), values.size() * sizeof(T));
    else
      for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::set<T>& values) {
    put(std::uint64_t{values.size()});
    for (const T& value : values) put(value);
  }
  template <class Key, class T>
  void put(const std::map<Key, T>& values) {
    put(std::uint64_t{values.size()});
    for (const auto& [key, value] : values) {
      put(key);
      put(value);
    }
  }

  std::string& bytes_;
};

/// Reads values in the order in which a Packer got them. Throws Error, which names `file`, where
/// the bytes end early.
class Unpacker {
 public:
  Unpacker(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) throw Error(file_, "is damaged: it holds less than it says");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  // Returns a number of values that take at least `size` bytes each, so that a damaged one cannot
  // ask for more memory than the file has bytes.
  std::size_t take_count(std::size_t size) {
    std::uint64_t count = 0;
    get(count);
    if (count > bytes_.size() / size) throw Error(file_, "is damaged: it holds less than it says");
    return static_cast<std::size_t>(count);
  }
  template <class T>
  void get(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>)
      std::memcpy(static_cast<void*>(&value), take(sizeof value).data(), sizeof value);
    else
      value.visit(*this);
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool is_there = false;
    get(is_there);
    value.reset();
    if (is_there) get(value.emplace());
  }
  void get(std::string& text) { text = take(take_count(1)); }
  template <class T>
  void get(std::vector<T>& values) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      values.resize(take_count(sizeof(T)));
      const std::string_view bytes = take(values.size() * sizeof(T));
      if (!bytes.empty())
        std::memcpy(static_cast<void*>(values.data()), bytes.data(), bytes.size());
    } else {
      values.resize(take_count(1));
      for (T& value : values) get(value);
    }
  }
  template <class T>
  void get(std::set<T>& values) {
    values.clear();
    for (std::size_t left = take_count(1); left > 0; --left) {
      T value{};
      get(value);
      values.insert(std::move(value));
    }
  }
  template <class Key, class T>
  void get(std::map<Key, T>& values) {
    values.clear();
    for (std::size_t left = take_count(1); left > 0; --left) {
      Key key{};
      get(key);
      get(values[std::move(key)]);
    }
  }

  std::string_view bytes_;
  std::string file_;
};

}  // namespace nightcity
