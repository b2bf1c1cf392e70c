#include "formats/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "formats/error.h"
#include "formats/foreign_file.h"
#include "formats/gltf_constants.h"
#include "formats/json_parse.h"
#include "formats/percent_text.h"

namespace nightcity::gltf {
namespace {

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

// Decodes base64 (RFC 4648). Returns nothing if a character is not of its alphabet.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
  static const auto table = [] {
    std::array<std::int8_t, 256> values;
    values.fill(-1);
    constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
      values[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
    return values;
  }();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const std::int8_t value = table[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xFFu));
    }
  }
  return bytes;
}

[[noreturn]] void wrong_type(const char* key, const char* wanted) {
  throw Error("", key, std::string("is not ") + wanted);
}

// Returns whether the first character that is no blank opens an object. A byte order mark may stand
// before it: RFC 8259, section 8.1, lets readers ignore it.
bool starts_as_json(std::span<const std::byte> bytes) {
  constexpr std::array mark{std::byte{0xEF}, std::byte{0xBB}, std::byte{0xBF}};
  if (bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin()))
    bytes = bytes.subspan(mark.size());
  const auto first = std::find_if(bytes.begin(), bytes.end(), [](std::byte b) {
    const char c = static_cast<char>(b);
    return c != ' ' && c != '\t' && c != '\r' && c != '\n';
  });
  return first != bytes.end() && static_cast<char>(*first) == '{';
}

[[noreturn]] void refuse_version(const std::string& name, const std::string& place,
                                 const std::string& version) {
  throw Error(name, place,
              "is glTF version " + version +
                  ", and this program reads version 2: convert it (gltf-pipeline does)");
}

}  // namespace

Document::Document(const std::filesystem::path& path) : name_(path.string()) {
  const auto bytes = files_->files.emplace_back(path).bytes();
  if (bytes.empty()) throw Error(name_, "is empty");
  const auto foreign = describe_foreign_file(bytes);
  if (bytes.size() >= 4 && word(bytes, 0) == glb_magic)
    read_container(bytes);
  else if (foreign || !starts_as_json(bytes))
    throw Error(name_, foreign.value_or("is not glTF"));
  else
    read_json(bytes);
  check_version();
  read_buffers(path.parent_path());
}

void Document::check_version() const {
  const Json& asset = member(root_, "asset");
  const Json &version = member(asset, "version"), &least = member(asset, "minVersion");
  if (!version.is_string()) throw Error(name_, "is not glTF: no asset version");
  const std::string found = version.get<std::string>();
  if (found.rfind("2.", 0) != 0) refuse_version(name_, "", found);
  // glTF 2.0, section 3.2: a reader of 2.0 may read every 2.x that does not ask for more.
  if (least.is_string() && least.get<std::string>() != "2.0")
    throw Error(name_, "asks for a reader of glTF " + least.get<std::string>() +
                           " (asset.minVersion); this program reads 2.0");
}

void Document::read_json(std::span<const std::byte> bytes) {
  root_ = parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name_);
}

void Document::read_container(std::span<const std::byte> bytes) {
  if (bytes.size() < 20)
    throw Error(name_, "byte " + std::to_string(bytes.size()), "ends in the header");
  if (word(bytes, 4) != 2) refuse_version(name_, "byte 4", std::to_string(word(bytes, 4)));
  // Bytes behind the container belong to whoever put them there, and are no part of it.
  if (word(bytes, 8) > bytes.size() || word(bytes, 8) < 12)
    throw Error(name_, "byte " + std::to_string(bytes.size()),
                "file of " + std::to_string(word(bytes, 8)) +
                    " bytes ends here: it is cut off, so copy or download it again");
  bytes = bytes.first(word(bytes, 8));
  bool first = true;
  for (std::size_t offset = 12; offset < bytes.size();) {
    const std::string place = "byte " + std::to_string(offset);
    if (bytes.size() - offset < 8) throw Error(name_, place, "chunk header is cut off");
    const std::size_t length = word(bytes, offset);
    const std::uint32_t type = word(bytes, offset + 4);
    if (length > bytes.size() - offset - 8)
      throw Error(name_, place, "chunk reaches beyond the file");
    if (first != (type == chunk_json))
      throw Error(name_, place, first ? "first chunk is not JSON" : "second JSON chunk");
    const auto content = bytes.subspan(offset + 8, length);
    if (first) read_json(content);
    if (type == chunk_binary && !binary_chunk_) binary_chunk_ = content;
    first = false;
    offset += 8 + length;
  }
}

void Document::read_buffers(const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < count("buffers"); ++i) {
    const Json& description = element("buffers", i);
    const std::string place = "buffer " + std::to_string(i);
    std::span<const std::byte> bytes;
    try {
      if (const std::string uri = text(description, "uri"); !uri.empty())
        bytes = external(uri, folder);
      else if (i == 0 && binary_chunk_)
        bytes = *binary_chunk_;
      else
        throw Error("", "names no file, and there is no binary chunk");
      const auto length = index(description, "byteLength");
      if (!length || *length > bytes.size()) throw Error("", "is shorter than its byteLength");
      buffers_.push_back(bytes.first(*length));
    } catch (const Error& error) {
      throw Error(name_, place, error.what());
    }
  }
}

std::span<const std::byte> Document::external(const std::string& uri,
                                              const std::filesystem::path& folder) {
  if (uri.rfind("data:", 0) == 0) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || uri.find(";base64") > comma)
      throw Error("", "data URI is not base64");
    auto bytes = decode_base64(std::string_view(uri).substr(comma + 1));
    if (!bytes) throw Error("", "data URI is not base64");
    return files_->decoded.emplace_back(std::move(*bytes));
  }
  if (uri.rfind("http://", 0) == 0 || uri.rfind("https://", 0) == 0)
    throw Error("", "is on the web (" + uri +
                        "), and this program loads nothing from there: download it, put it beside "
                        "the scene and name it without a server");
  // A scene may refer to files beside it only: other places could be secrets of the reader's
  // machine.
  const auto check = [&](const std::filesystem::path& relative) {
    if (uri.find("://") != std::string::npos || relative.is_absolute())
      throw Error("", "URI is not relative: " + uri);
    if (!relative.empty() && *relative.lexically_normal().begin() == "..")
      throw Error("", "URI leaves the scene's folder: " + uri);
  };
  const std::string decoded = decode_percent(uri);
  // Exporters on Windows write its separator, which no URI has, and blanks and percent signs as
  // they are. The first of these spellings that names a file is meant.
  std::vector<std::string> spellings{decoded};
  if (decoded != uri) spellings.push_back(uri);
  if (decoded.find('\\') != std::string::npos) {
    std::string slashes = decoded;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    spellings.push_back(std::move(slashes));
  }
  for (const std::string& spelling : spellings) check(spelling);
  for (const std::string& spelling : spellings)
    if (std::error_code error; std::filesystem::exists(folder / spelling, error) && !error)
      return files_->files.emplace_back(folder / spelling).bytes();
  throw Error("", (folder / spellings.front()).string() +
                      " is not there: the scene needs it, so keep both together");
}

std::span<const std::byte> Document::file(const std::string& uri) {
  return external(uri, std::filesystem::path(name_).parent_path());
}

std::size_t Document::bytes() const {
  std::size_t total = 0;
  for (const MappedFile& file : files_->files) total += file.bytes().size();
  for (const auto& decoded : files_->decoded) total += decoded.size();
  return total;
}

std::shared_ptr<const SceneBytes> Document::take_files(Json& json) {
  json = std::exchange(root_, nullptr);
  return files_;
}

std::size_t Document::count(const char* name) const {
  const Json& array = member(root_, name);
  if (!array.is_null() && !array.is_array()) wrong_type(name, "an array");
  return array.size();
}

const Json& Document::element(const char* name, std::size_t index) const {
  if (index >= count(name))
    throw Error("", std::string(name) + "[" + std::to_string(index) + "]", "is not there");
  return root_.at(name).at(index);
}

std::span<const std::byte> Document::buffer(std::size_t index) const {
  if (index >= buffers_.size()) throw Error("", "buffer " + std::to_string(index), "is not there");
  return buffers_[index];
}

const Json& member(const Json& object, const char* key) {
  static const Json null;
  if (!object.is_object()) return null;
  const auto found = object.find(key);
  return found == object.end() ? null : *found;
}

const Json& extension(const Json& object, const char* name) {
  return member(member(object, "extensions"), name);
}

std::optional<std::size_t> index(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (value.is_null()) return std::nullopt;
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  // JSON does not tell integers from other numbers: some exporters write 3.0.
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number >= 0 && number < 0x1p53 && number == std::floor(number))
      return static_cast<std::size_t>(number);
  }
  wrong_type(key, "a whole number of 0 or more");
}

double number(const Json& object, const char* key, double otherwise) {
  const Json& value = member(object, key);
  if (value.is_null()) return otherwise;
  if (!value.is_number()) wrong_type(key, "a number");
  return value.get<double>();
}

std::string text(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (value.is_null()) return {};
  if (!value.is_string()) wrong_type(key, "a string");
  return value.get<std::string>();
}

bool boolean(const Json& object, const char* key, bool otherwise) {
  const Json& value = member(object, key);
  if (value.is_null()) return otherwise;
  if (!value.is_boolean()) wrong_type(key, "true or false");
  return value.get<bool>();
}

}  // namespace nightcity::gltf
