#include "tools/city/archive_entries.h"

#include <optional>
#include <string_view>
#include <utility>

#include "formats/error.h"
#include "formats/file_names.h"
#include "formats/scratch_file.h"
#include "formats/to_lower.h"
#include "tools/city/file_stamp.h"
#include "tools/city/libarchive_reader.h"
#include "tools/city/packing.h"
#include "tools/city/rar_sums.h"
#include "tools/city/stream_source.h"
#include "tools/city/text_encoding.h"
#include "tools/city/unpacked_archive.h"
#include "tools/city/unpacked_size.h"
#include "tools/city/zip_archive.h"

namespace nightcity::city {
namespace {

constexpr std::size_t copied_block = std::size_t{1} << 16;

std::shared_ptr<ScratchFile> copy_to_scratch(ByteSource& source, UnpackedSize& unpacked) {
  auto file = std::make_shared<ScratchFile>(scratch_folder() / "archive");
  for (std::string bytes = read_next(source, copied_block); !bytes.empty();
       bytes = read_next(source, copied_block)) {
    unpacked.add(bytes.size());
    file->write(bytes.data(), bytes.size());
  }
  file->flush();
  return file;
}

// Returns what an archive at `path` holds, without looking into archives in it; none where it is no
// archive. `file`: that it lies in, where this has no name.
std::optional<ArchiveListing> list_one(const std::string& path, const std::string& name,
                                       const std::shared_ptr<ScratchFile>& file,
                                       UnpackedSize& unpacked) {
  const std::string start = read_next(*open_file(path), packing_bytes);
  const Packing packing = find_packing(start);
  if (packing == Packing::none) return std::nullopt;
  if (packing == Packing::zip) return list_zip(path, name, file);
  if (packing == Packing::tar) {
    LibarchiveReader reader(packing, open_file(path), name);
    return unpack_archive(reader, unpacked);
  }
  if (is_archive(packing)) {
    if (packing == Packing::rar && is_rar_volume(start)) throw Error(name, volume_words);
    LibarchiveReader reader(packing, path, name);
    return unpack_archive(reader, unpacked,
                          packing == Packing::rar ? list_rar_sums(path) : EntrySums());
  }
  auto source = unpack_stream(packing, open_file(path), name, find_packed_size(path));
  std::string inner_start = read_next(*source, packing_bytes);
  const Packing inner = find_packing(inner_start);
  if (!is_archive(inner)) return std::nullopt;
  source = resume(std::move(inner_start), std::move(source));
  if (inner == Packing::tar) {
    LibarchiveReader reader(inner, std::move(source), name);
    return unpack_archive(reader, unpacked);
  }
  const auto unpacked_file = copy_to_scratch(*source, unpacked);
  return list_one(unpacked_file->path_while_open().string(), name, unpacked_file, unpacked);
}

// Returns what the archive holds that an entry is; none where it is only named like one.
std::optional<ArchiveListing> list_inner(const ArchiveEntry& entry, const std::string& path,
                                         UnpackedSize& unpacked) {
  if (!is_named_as_archive(to_lower(entry.inside))) return std::nullopt;
  const std::string name = path + "/" + entry.inside;
  auto source = entry.archive->open(entry.index, name);
  std::string start = read_next(*source, packing_bytes);
  if (find_packing(start) == Packing::none) return std::nullopt;
  const auto file = copy_to_scratch(*resume(std::move(start), std::move(source)), unpacked);
  return list_one(file->path_while_open().string(), name, file, unpacked);
}

ArchiveListing list_with_inner_archives(const std::string& path) {
  UnpackedSize unpacked(path, find_packed_size(path));
  std::optional<ArchiveListing> outer = list_one(path, path, nullptr, unpacked);
  if (!outer) throw Error(path, "is no archive");
  ArchiveListing all;
  all.left_out = std::move(outer->left_out);
  all.entries.reserve(outer->entries.size());
  for (ArchiveEntry& entry : outer->entries) {
    std::optional<ArchiveListing> inner = list_inner(entry, path, unpacked);
    if (!inner) {
      all.entries.push_back(std::move(entry));
      continue;
    }
    for (ArchiveEntry& one : inner->entries) {
      one.inside.insert(0, entry.inside + "/");
      all.entries.push_back(std::move(one));
    }
    for (const auto& [what, count] : inner->left_out) all.left_out[what] += count;
  }
  return all;
}

// Returns how many bytes lie on the disk for the entries.
std::uint64_t count_kept_bytes(const ArchiveListing& listing) {
  std::uint64_t bytes = 0;
  const OpenArchive* last = nullptr;  // entries of one archive follow each other
  for (const ArchiveEntry& entry : listing.entries)
    if (entry.archive.get() != last) bytes += (last = entry.archive.get())->kept_bytes();
  return bytes;
}

}  // namespace

std::unique_ptr<ByteSource> ArchiveEntry::open(const std::string& name) const {
  return archive->open(index, name);
}

bool holds_archive(const std::string& path, std::string_view start) {
  const Packing packing = find_packing(start);
  if (!is_stream(packing)) return is_archive(packing);
  try {
    const auto source = unpack_stream(packing, open_file(path), path, find_packed_size(path));
    return is_archive(find_packing(read_next(*source, packing_bytes)));
  } catch (const Error&) {
    return false;  // broken, as its reader says
  }
}

Packing find_packing_of(const std::filesystem::path& file) {
  std::error_code ignored;  // the readers say what is wrong with a file
  if (!std::filesystem::is_regular_file(file, ignored)) return Packing::none;
  return find_packing(read_next(*open_file(file.string()), packing_bytes));
}

bool is_archive_file(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) &&
         holds_archive(file.string(), read_next(*open_file(file.string()), packing_bytes));
}

std::shared_ptr<const ArchiveListing> list_archive(const std::filesystem::path& path) {
  static LastOfFiles<std::shared_ptr<const ArchiveListing>> last;
  return last.find(
      path,
      [&] {
        return std::make_shared<const ArchiveListing>(list_with_inner_archives(path.string()));
      },
      [](const auto& listing) { return count_kept_bytes(*listing); });
}

}  // namespace nightcity::city
