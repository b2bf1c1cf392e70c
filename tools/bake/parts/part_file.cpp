#include "tools/bake/parts/part_file.h"

#include <cstring>
#include <fstream>
#include <utility>

#include "formats/checksum.h"
#include "formats/error.h"
#include "formats/input_file.h"
#include "tools/archive.h"

namespace nightcity::bake {
namespace {

// Raised when a part holds something else than before.
constexpr char magic[8] = {'N', 'C', 'P', 'A', 'R', 'T', '0', '5'};

struct Frame {
  std::uint32_t kind, unused;
  std::uint64_t size, checksum;
};

}  // namespace

PartWriter::PartWriter(const std::filesystem::path& path, const PartHead& head) : file_(path) {
  file_.write(magic, sizeof magic);
  std::string bytes;
  Packer{bytes}(head);
  write(BlockKind::head, bytes);
}

void PartWriter::write(BlockKind kind, const std::string& bytes) {
  try {
    const Frame frame{static_cast<std::uint32_t>(kind), 0, bytes.size(),
                      checksum(bytes.data(), bytes.size())};
    file_.write(&frame, sizeof frame);
    file_.write(bytes);
  } catch (...) {
    has_failed_ = true;
    throw;
  }
}

void PartWriter::commit() {
  write(BlockKind::end, {});
  file_.commit();
}

PartReader::PartReader(const std::filesystem::path& path) : name_(path.string()) {
  refuse_special_file(path);
  file_.reset(std::fopen(path.c_str(), "rbe"));
  if (!file_) throw Error(name_, "cannot open: is there such a part?");
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  char found[sizeof magic] = {};
  if (error || std::fread(found, 1, sizeof found, file_.get()) != sizeof found ||
      std::memcmp(found, magic, sizeof magic) != 0)
    throw Error(name_, "is no part of a bake, or one of another version of nightbake");
  at_ = sizeof magic;
  const Block head = read_block(false);
  if (head.kind != BlockKind::head) fail_damaged();
  Unpacker{head.bytes, name_}(head_);
  first_ = at_;
}

void PartReader::fail_damaged() const {
  throw Error(name_, "is damaged or cut off: remove it, and make this part again");
}

PartReader::Block PartReader::read_block(bool skip_objects) {
  Frame frame{};
  if (std::fread(&frame, 1, sizeof frame, file_.get()) != sizeof frame) fail_damaged();
  at_ += sizeof frame;
  if (frame.size > size_ - at_) fail_damaged();
  Block block{static_cast<BlockKind>(frame.kind), {}};
  at_ += frame.size;
  if (skip_objects && block.kind == BlockKind::objects) {
    if (::fseeko(file_.get(), static_cast<off_t>(at_), SEEK_SET) != 0) fail_damaged();
    return block;
  }
  block.bytes.resize(static_cast<std::size_t>(frame.size));
  if (std::fread(block.bytes.data(), 1, block.bytes.size(), file_.get()) != block.bytes.size() ||
      checksum(block.bytes.data(), block.bytes.size()) != frame.checksum)
    fail_damaged();
  return block;
}

PartReader::Block PartReader::next(bool skip_objects) {
  Block block = read_block(skip_objects);
  while (skip_objects && block.kind == BlockKind::objects) block = read_block(skip_objects);
  return block;
}

bool PartReader::is_complete() const {
  Frame last{};
  std::ifstream file(name_, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(sizeof last), std::ios::end);
  file.read(reinterpret_cast<char*>(&last), sizeof last);
  return file && last.kind == static_cast<std::uint32_t>(BlockKind::end) && last.size == 0;
}

void PartReader::rewind() {
  if (::fseeko(file_.get(), static_cast<off_t>(first_), SEEK_SET) != 0) fail_damaged();
  at_ = first_;
}

std::optional<PartHead> read_part_head(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  try {
    const PartReader reader(path);
    if (!reader.is_complete()) return {};
    return reader.head();
  } catch (const Error&) {
    return {};
  }
}

}  // namespace nightcity::bake
