// Objects with pictures are large, so readers do not gather them.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/temp_folder.h"
#include "tests/tools/citygml/small_city.h"
#include "tests/tools/cityjson/small_cityjson.h"
#include "tools/inputs/read_city.h"

namespace nightcity::inputs {
namespace {

using namespace test;

// Returns how many objects each call of the stage had.
std::vector<std::size_t> list_calls(const std::filesystem::path& file, city::Textures textures) {
  city::ReadOptions options;
  options.threads = 1;
  options.textures = textures;
  options.mesh.up = city::MeshPlacement::Up::z;
  std::vector<std::size_t> calls;
  read_city_staged(file, options, [&](std::vector<city::CityObject>&& objects) {
    if (!objects.empty()) calls.push_back(objects.size());
    return std::function<void()>();
  });
  return calls;
}

TEST(OneByOne, ObjectsWithPicturesPassAloneInEachFormat) {
  const TempFolder folder;
  std::string members, objects, lines = header(), faces = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (const std::string id : {"a", "b", "c"}) {
    members +=
        member("<bldg:Building gml:id=\"" + id + "\"><bldg:lod2MultiSurface><gml:MultiSurface>" +
               surface_member(polygon("p" + id, square_at_one)) +
               "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:Building>");
    objects += (objects.empty() ? "" : ",") + object(id, "Building", solid());
    lines += feature(id, object(id, "Building", solid()));
    faces += "o " + id + "\nf 1 2 3\n";
  }
  const std::pair<const char*, std::string> files[] = {{"city.gml", city_model(members)},
                                                       {"city.json", city_json(objects)},
                                                       {"city.jsonl", lines},
                                                       {"city.obj", faces}};
  for (const auto& [name, text] : files) {
    write_text(folder / name, text);
    EXPECT_EQ(list_calls(folder / name, city::Textures::atlas), (std::vector<std::size_t>{1, 1, 1}))
        << name;
    EXPECT_EQ(list_calls(folder / name, city::Textures::none), (std::vector<std::size_t>{3}))
        << name;
  }
}

}  // namespace
}  // namespace nightcity::inputs
