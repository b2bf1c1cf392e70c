// A text that is in memory, read as a document is.
#pragma once

#include <cstddef>
#include <string_view>

#include "tools/city/byte_source.h"

namespace nightcity::city {

/// The text lives longer than its source.
class TextSource : public ByteSource {
 public:
  explicit TextSource(std::string_view text) : rest_(text) {}
  std::size_t read(char* out, std::size_t size) override {
    const std::size_t got = rest_.copy(out, size);
    rest_.remove_prefix(got);
    return got;
  }

 private:
  std::string_view rest_;
};

}  // namespace nightcity::city
