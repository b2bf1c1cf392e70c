// A CityGML document held in memory.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

#include "tools/city/byte_source.h"

namespace nightcity::test {

class MemorySource : public city::ByteSource {
 public:
  explicit MemorySource(const std::string& text) : text_(text) {}
  std::size_t read(char* out, std::size_t size) override {
    const std::size_t n = std::min(size, text_.size() - at_);
    std::memcpy(out, text_.data() + at_, n);
    at_ += n;
    return n;
  }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
};

/// `text` must outlive the document.
inline city::Document memory_document(const std::string& text) {
  return {"memory", false, [&text] { return std::make_unique<MemorySource>(text); }};
}

}  // namespace nightcity::test
