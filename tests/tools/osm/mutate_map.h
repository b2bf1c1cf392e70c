// libFuzzer's mutations of packed maps: they change what is packed and pack it again, because bytes
// that are changed in a deflated block end in zlib's checksum, before our readers.
#pragma once

#include <zlib.h>
#include <protozero/pbf_reader.hpp>
#include <protozero/pbf_writer.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace nightcity::test {

constexpr std::size_t max_unpacked_map = std::size_t{1} << 18;

/// Returns what a deflated text unpacks to, in gzip or zlib's own wrapping; cut off at
/// `max_unpacked_map`, "" where it is broken from the start.
inline std::string inflate_map(std::string_view packed) {
  std::string text(max_unpacked_map, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 32) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  inflate(&stream, Z_FINISH);
  text.resize(text.size() - stream.avail_out);
  inflateEnd(&stream);
  return text;
}

/// `window_bits`: 15 for zlib's wrapping, 31 for gzip's.
inline std::string deflate_map(std::string_view text, int window_bits) {
  std::string packed(text.size() + 1024, '\0');
  z_stream stream{};
  if (deflateInit2(&stream, 1, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(packed.size() - stream.avail_out);
  deflateEnd(&stream);
  return packed;
}

/// Mutates the packed maps of a fuzzer, one call of libFuzzer's mutator for each.
class MapMutator {
 public:
  explicit MapMutator(unsigned seed) : random_(seed) {}

  /// Returns a PBF with one of its blobs changed within; "" where its blobs cannot be followed.
  std::string mutate_pbf(std::string_view file) {
    struct Blob {
      std::string_view type, blob;
    };
    std::vector<Blob> blobs;
    try {
      while (file.size() >= 4) {
        std::size_t head_size = 0;
        for (std::size_t i = 0; i < 4; ++i)
          head_size = head_size << 8 | static_cast<std::uint8_t>(file[i]);
        file.remove_prefix(4);
        if (head_size > file.size()) break;
        Blob& next = blobs.emplace_back();
        std::size_t size = 0;
        protozero::pbf_reader head(file.data(), head_size);
        while (head.next())
          if (head.tag_and_type() == tag_and_type(1, bytes))
            next.type = to_text(head.get_view());
          else if (head.tag_and_type() == tag_and_type(3, varint))
            size = head.get_uint32();
          else
            head.skip();
        file.remove_prefix(head_size);
        next.blob = file.substr(0, size);
        file.remove_prefix(next.blob.size());
      }
      if (blobs.empty()) return {};
      const std::size_t chosen = draw(blobs.size());
      std::string out;
      for (std::size_t i = 0; i < blobs.size(); ++i)
        append_blob(blobs[i].type,
                    i == chosen ? mutate_blob(blobs[i].blob) : std::string(blobs[i].blob), out);
      return out;
    } catch (const protozero::exception&) {
      return {};
    }
  }

  std::string mutate_gzip(std::string_view file) {
    return deflate_map(mutate_bytes(inflate_map(file)), 15 + 16);
  }

 private:
  static constexpr auto varint = protozero::pbf_wire_type::varint;
  static constexpr auto bytes = protozero::pbf_wire_type::length_delimited;

  static std::string_view to_text(const protozero::data_view& view) {
    return {view.data(), view.size()};
  }

  std::size_t draw(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

  static std::string mutate_bytes(std::string text) {
    const std::size_t size = text.size(), room = size + 64;
    text.resize(room);
    text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, room));
    return text;
  }

  // Mutates a message, or one of those in it, so that all lengths around it stay right.
  std::string mutate_message(std::string_view message, int depth = 0) {
    constexpr int max_depth = 5;
    std::vector<std::string_view> parts;  // payloads of fields that may be messages
    try {
      protozero::pbf_reader fields(message.data(), message.size());
      while (fields.next())
        if (fields.wire_type() == bytes)
          parts.push_back(to_text(fields.get_view()));
        else
          fields.skip();
    } catch (const protozero::exception&) {
      parts.clear();  // text, or packed numbers
    }
    if (parts.empty() || depth == max_depth || draw(4) == 0)
      return mutate_bytes(std::string(message));
    const std::size_t chosen = draw(parts.size());
    std::string out;
    protozero::pbf_writer writer(out);
    protozero::pbf_reader fields(message.data(), message.size());
    for (std::size_t part = 0; !fields.data().empty();) {
      const char* const begin = fields.data().data();
      fields.next();
      const auto tag = fields.tag();
      const bool is_part = fields.wire_type() == bytes;
      fields.skip();
      if (is_part && part++ == chosen)
        writer.add_bytes(tag, mutate_message(parts[chosen], depth + 1));
      else
        out.append(begin, fields.data().data());
    }
    return out;
  }

  // One in four is stored without packing, as the format allows.
  std::string mutate_blob(std::string_view blob) {
    std::string text;
    for (protozero::pbf_reader fields(blob.data(), blob.size()); fields.next();)
      if (fields.tag_and_type() == tag_and_type(1, bytes))
        text = fields.get_string();
      else if (fields.tag_and_type() == tag_and_type(3, bytes))
        text = inflate_map(to_text(fields.get_view()));
      else
        fields.skip();
    text = mutate_message(text);
    std::string out;
    protozero::pbf_writer writer(out);
    if (draw(4) == 0) {
      writer.add_bytes(1, text);
    } else {
      writer.add_int32(2, static_cast<std::int32_t>(text.size()));
      writer.add_bytes(3, deflate_map(text, 15));
    }
    return out;
  }

  static void append_blob(std::string_view type, const std::string& blob, std::string& out) {
    std::string head;
    protozero::pbf_writer writer(head);
    writer.add_bytes(1, type.data(), type.size());
    writer.add_int32(3, static_cast<std::int32_t>(blob.size()));
    for (int shift = 24; shift >= 0; shift -= 8)
      out.push_back(static_cast<char>(head.size() >> shift & 0xFF));
    out += head + blob;
  }

  std::mt19937 random_;
};

}  // namespace nightcity::test

/// One in eight mutations is libFuzzer's own, so that headers and packings are changed too.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  nightcity::test::MapMutator mutator(seed);
  std::string mutated;
  if (seed % 8 != 0) {
    if (file.starts_with("\x1f\x8b"))
      mutated = mutator.mutate_gzip(file);
    else if (file.starts_with(std::string_view("\0\0", 2)))
      mutated = mutator.mutate_pbf(file);
  }
  if (mutated.empty() || mutated.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(mutated.begin(), mutated.end(), data);
  return mutated.size();
}
