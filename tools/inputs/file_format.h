// Finds the kind of file that a path names. This table is the one place that decides it: recipes,
// the inputs of commands and `inspect` all ask here. A new reader joins by one row.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::inputs {

/// The kinds of content that a file is read as.
enum class FileKind { city, osm, scene, lights, luminaire };

/// The beginning of a file.
struct FileStart {
  std::string_view bytes;  // of the content, unpacked; at most 64 KiB
  std::string_view name;   // of the file without its folder, in lower case
  bool packed = false;     // the file is a stream (gzip, xz, ...) or an archive
};

struct FileFormat {
  const char* name;  // as in messages: "CityGML"
  FileKind kind;
  bool (*recognises)(const FileStart& start);
  /// Its reader unpacks streams and archives.
  bool may_be_packed = false;
  /// City formats: how the names of files end that a folder or an archive is searched for, in lower
  /// case and without .gz.
  std::span<const std::string_view> endings{};
  /// City formats, and maps, whose buildings can be a city; null for the others.
  const city::FileReader* reader = nullptr;
};

/// All formats, in the order in which they are tried: those with a sure mark first.
std::span<const FileFormat> file_formats();

/// Returns the documents of a file that may be city models or maps. Throws Error as
/// city::list_contents.
city::FileContents list_readable(const std::filesystem::path& path);

/// Returns the format of the file at `path` by its first bytes; a name decides only where these say
/// nothing (.ies, .ldt). Throws Error: missing, empty, a folder, a broken archive,
/// or of no format in the table; the message then says what it is instead, and the remedy
/// (tools/city/foreign_format.h). Of an archive the first city model decides, or else the first
/// entry of another format.
const FileFormat& find_format(const std::filesystem::path& path);
/// The same of a file's documents, where they have been listed.
const FileFormat& find_format(const std::vector<city::Document>& documents);

/// Returns the format of one document of a file, by its first bytes; null: none of the table.
const FileFormat* find_format(const city::Document& document);

/// Returns why a file that lies in a folder of city files is none of them: metadata, a code list, a
/// map. "" for a city file, and for one that cannot be told: its reader then says what is wrong.
/// Throws Error where it cannot be read.
std::string find_reason_to_pass_over(const std::filesystem::path& path);

}  // namespace nightcity::inputs
