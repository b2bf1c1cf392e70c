#include "tools/bake/file_kind.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "formats/error.h"
#include "formats/mapped_file.h"

namespace nightcity {

FileKind file_kind(const std::filesystem::path& path) {
  const MappedFile file(path);
  if (file.bytes().empty()) throw Error(path.string(), "is empty");
  constexpr std::size_t enough = 65536;  // XML may begin with long comments
  const std::string_view start(reinterpret_cast<const char*>(file.bytes().data()),
                               std::min(file.bytes().size(), enough));
  const auto has = [start](std::string_view text) {
    return start.find(text) != std::string_view::npos;
  };
  if (start.starts_with("glTF")) return FileKind::scene;
  if (start.starts_with("NCLIGHTS")) return FileKind::lights;
  if (start.substr(0, 64).find("OSMHeader") != std::string_view::npos)
    return FileKind::osm;  // .osm.pbf
  const bool compressed =
      start.starts_with("\x1f\x8b") || start.starts_with("BZh") || start.starts_with("PK\x03\x04");
  if (compressed)
    return path.filename().string().find(".osm") != std::string::npos ? FileKind::osm
                                                                      : FileKind::citygml;
  if (has("<osm ") || has("<osm>")) return FileKind::osm;
  if (has("CityModel")) return FileKind::citygml;
  const std::size_t first = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first != std::string_view::npos && start[first] == '{' && has("\"asset\""))
    return FileKind::scene;
  // A large glTF may name its asset last.
  if (first != std::string_view::npos && start[first] == '{' && path.extension() == ".gltf")
    return FileKind::scene;
  // IES files say so or hold a TILT line; EULUMDAT has no mark at all but its name.
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (start.starts_with("IESNA") || has("\nTILT=") || extension == ".ies" || extension == ".ldt")
    return FileKind::luminaire;
  throw Error(path.string(), "is neither CityGML, OSM, glTF, a light file nor a luminaire");
}

}  // namespace nightcity
