#include "formats/foreign_file.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "formats/packed_file.h"

namespace nightcity {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view start;
  const char* message;
};

// In this order: the first that matches decides.
constexpr Signature binary_signatures[] = {
    {"\x1f\x8b"sv, "is gzip-compressed: decompress it first (gunzip)"},
    {"BZh"sv, "is bzip2-compressed: decompress it first (bunzip2)"},
    {"PK\x03\x04"sv,
     "is a zip archive (KMZ, USDZ and 3TZ are, too): unpack it, and give the .glb or .gltf in it"},
    {"b3dm"sv, "is a 3D tile (b3dm), not glTF: take the glTF out of it (3d-tiles-tools b3dmToGlb)"},
    {"i3dm"sv, "is a 3D tile (i3dm), not glTF: take the glTF out of it (3d-tiles-tools i3dmToGlb)"},
    {"cmpt"sv, "is a 3D tile (cmpt), not glTF: take the glTF out of it (3d-tiles-tools cmptToGlb)"},
    {"pnts"sv, "is a 3D tile of points (pnts), which have no surface"},
    {"NCLIGHTS"sv, "is a light file, not a scene: give the .glb beside it"},
    {"Kaydara FBX Binary"sv, "is FBX, not glTF: export it as glTF (Blender does)"},
    {"; FBX"sv, "is FBX, not glTF: export it as glTF (Blender does)"},
    {"BLENDER"sv, "is a Blender file: export it as glTF"},
    {"PXR-USDC"sv, "is USD, not glTF: export it as glTF (Blender does)"},
    {"#usda"sv, "is USD, not glTF: export it as glTF (Blender does)"},
    {"ply\n"sv, "is PLY, not glTF: export it as glTF (Blender does)"},
    {"ply\r"sv, "is PLY, not glTF: export it as glTF (Blender does)"},
    {"solid "sv, "is STL, not glTF: export it as glTF (Blender does)"},
    {"\x89PNG"sv, "is a picture, not a scene"},
    {"\xff\xd8\xff"sv, "is a picture, not a scene"},
    {"\x76\x2f\x31\x01"sv, "is a picture (OpenEXR), not a scene"},
    {"version https://git-lfs"sv,
     "is a pointer of Git LFS, not the file itself: fetch it (git lfs pull)"},
    {"\xff\xfe"sv, "is text in UTF-16: glTF is UTF-8; save it as that"},
    {"\xfe\xff"sv, "is text in UTF-16: glTF is UTF-8; save it as that"},
};

// Returns whether `text` contains `word`, given in lower case; the case of `text` does not matter.
bool contains(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
  };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

std::optional<std::string> describe_markup(std::string_view head) {
  if (contains(head, "citymodel")) return "is CityGML, not glTF: bake it first (nightbake run)";
  if (contains(head, "<html") || contains(head, "<!doctype html"))
    return "is a web page (HTML): the download gave a message instead of the file";
  if (contains(head, "<collada"))
    return "is COLLADA, not glTF: export it as glTF (COLLADA2GLTF and Blender do)";
  if (contains(head, "<osm")) return "is a map (OSM), not glTF: bake it first (nightbake run)";
  if (contains(head, "<x3d")) return "is X3D, not glTF: export it as glTF";
  return "is XML, not glTF";
}

std::optional<std::string> describe_json(std::string_view head) {
  if (contains(head, "\"cityjson")) return "is CityJSON, not glTF: bake it first (nightbake run)";
  if (contains(head, "\"geometricerror\""))
    return "is a tileset of 3D Tiles: give one of the .glb files that it names";
  if (contains(head, "\"featurecollection\"")) return "is GeoJSON, not glTF";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> describe_foreign_file(std::span<const std::byte> bytes) {
  constexpr std::size_t head_bytes = 4096;
  std::string_view head(reinterpret_cast<const char*>(bytes.data()),
                        std::min(bytes.size(), head_bytes));
  for (const Signature& signature : binary_signatures)
    if (head.starts_with(signature.start)) return signature.message;
  if (const std::string_view packed = describe_packed(head); !packed.empty())
    return std::string(packed);
  if (head.starts_with("\xef\xbb\xbf"sv)) head.remove_prefix(3);
  const std::size_t start = head.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return std::nullopt;
  head.remove_prefix(start);
  if (head.front() == '<') return describe_markup(head);
  if (head.front() == '{') return describe_json(head);
  if (head.starts_with("mtllib "sv) || head.starts_with("o "sv) || head.starts_with("v "sv))
    return "is Wavefront OBJ, not glTF: export it as glTF (Blender does)";
  return std::nullopt;
}

std::string describe_required_extension(const std::string& name) {
  if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
    return "its meshes are compressed with meshoptimizer (" + name +
           "), which this program does not decode: write it without (gltf-transform copy IN.glb "
           "OUT.glb, or export it again without compression)";
  return "requires the extension " + name + ", which this program does not know: export it without";
}

}  // namespace nightcity
