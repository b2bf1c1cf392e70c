// Pictures of a city model on the surfaces of a scene: the same colour at every place of a wall,
// whatever is cut, packed and made smaller on the way.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "formats/picture_mean.h"
#include "formats/scene_reader.h"
#include "formats/srgb.h"
#include "support/data.h"
#include "support/make_png.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/bake/bake.h"
#include "tools/bake/scene/atlas.h"

namespace nightcity::bake {
namespace {

using namespace test;
using Pixel = std::array<unsigned char, 3>;

constexpr int width_m = 16, height_m = 8, pixels_per_m = 8, square = 32;
constexpr Pixel light_field{200, 120, 60}, dark_field{90, 90, 30};

Pixel chequer(std::size_t x, std::size_t y) {
  return (x / square + y / square) % 2 == 0 ? light_field : dark_field;
}

void write_chequer(const fs::path& path) {
  write_text(path, make_rgb_png(width_m * pixels_per_m, height_m * pixels_per_m, chequer));
}

std::string ring_of(const std::string& id, const std::string& places) {
  return "<gml:LinearRing gml:id=\"" + id + "_ring\"><gml:posList>" + places +
         "</gml:posList></gml:LinearRing>";
}

std::string polygon_of(const std::string& id, const std::string& places) {
  return surface_member("<gml:Polygon gml:id=\"" + id + "\"><gml:exterior>" + ring_of(id, places) +
                        "</gml:exterior></gml:Polygon>");
}

// A wall that faces south, its lower left corner at `east` and northing 5819000.
std::string wall_at(const std::string& id, int east) {
  const std::string w = std::to_string(391000 + east), e = std::to_string(391000 + east + width_m),
                    n = " 5819000 ", top = std::to_string(height_m);
  return polygon_of(
      id, w + n + "0 " + e + n + "0 " + e + n + top + " " + w + n + top + " " + w + n + "0");
}

std::string texture_of(const std::string& picture, const std::string& id,
                       const std::string& coordinates = "0 0 1 0 1 1 0 1 0 0") {
  return "<app:surfaceDataMember><app:ParameterizedTexture><app:imageURI>" + picture +
         "</app:imageURI><app:target uri=\"#" + id +
         "\"><app:TexCoordList><app:textureCoordinates ring=\"#" + id + "_ring\">" + coordinates +
         "</app:textureCoordinates></app:TexCoordList></app:target></app:ParameterizedTexture>"
         "</app:surfaceDataMember>";
}

std::string appearance(const std::string& data) {
  return "<app:appearance><app:Appearance>" + data + "</app:Appearance></app:appearance>";
}

std::string house_of(const std::string& id, const std::string& walls, const std::string& textures) {
  return member("<bldg:Building gml:id=\"" + id + "\">" + appearance(textures) +
                boundary("WallSurface", walls) + "</bldg:Building>");
}

class TexturesTest : public testing::Test {
 protected:
  // Bakes a city of these members, and returns the scene.
  Scene bake_scene(const std::string& members, double texels_per_m = pixels_per_m) {
    write_text(folder / "city.gml", city_model(members));
    Recipe recipe;
    recipe.city.files = {folder / "city.gml"};
    recipe.city.read.textures = city::Textures::atlas;
    recipe.city.texels_per_m = texels_per_m;
    recipe.city.max_picture_mpx = max_picture_mpx;
    recipe.windows.lit = false;
    report = bake(recipe, folder / "out");
    return read_scene(folder / "out" / "city.glb");
  }
  const TempFolder folder;
  BakeReport report;
  int max_picture_mpx = Recipe().city.max_picture_mpx;
};

// Looks up the colour of a scene at places of its walls: (metres east, metres up) from a corner.
class Walls {
 public:
  explicit Walls(const Scene& scene) : scene_(scene) {
    for (const ScenePicture& picture : scene.pictures) pictures_.push_back(Picture::read(picture));
  }

  std::optional<Pixel> at(double east, double up) const {
    for (const SceneNode& node : scene_.nodes) {
      const glm::dvec3 place(node.instances.at(0).to_model[3]);
      for (const ScenePrimitive& p : scene_.meshes[node.mesh].primitives) {
        if (p.texture_coordinates.empty()) continue;
        for (std::size_t i = 0; i < p.indices.size(); i += 3)
          if (const auto found = find(p, i, place, east, up)) return found;
      }
    }
    return std::nullopt;
  }

 private:
  std::optional<Pixel> find(const ScenePrimitive& p, std::size_t first, const glm::dvec3& place,
                            double east, double up) const {
    glm::dvec2 c[3], uv[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 at =
          scene_.georeference.from_model(place + glm::dvec3(p.positions[p.indices[first + k]]));
      c[k] = {at.x - 391000, at.z};
      uv[k] = p.texture_coordinates[p.indices[first + k]];
    }
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) {
      return a.x * b.y - a.y * b.x;
    };
    const double area = cross(c[1] - c[0], c[2] - c[0]);
    const glm::dvec2 q(east, up);
    const double b = cross(q - c[0], c[2] - c[0]) / area, d = cross(c[1] - c[0], q - c[0]) / area;
    if (b < 0 || d < 0 || b + d > 1) return std::nullopt;
    const glm::dvec2 at = uv[0] + b * (uv[1] - uv[0]) + d * (uv[2] - uv[0]);
    const Picture& picture = *pictures_.at(scene_.materials[p.material].texture->picture);
    const int x = static_cast<int>(at.x * picture.width()),
              y = static_cast<int>(at.y * picture.height());
    const auto* pixel = picture.pixels().data() + 4 * (y * picture.width() + x);
    return Pixel{pixel[0], pixel[1], pixel[2]};
  }

  const Scene& scene_;
  std::vector<std::optional<Picture>> pictures_;
};

void expect_alike(const Pixel& a, const Pixel& b, int difference, const std::string& where) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], difference) << where;
}

// A metre away from the edges of fields. `difference`: what a JPEG changes, which is more where an
// edge lies within its blocks of 16 texels.
void expect_chequer(const Scene& scene, int difference = 8) {
  const Walls walls(scene);
  for (int x = 0; x < width_m; ++x)
    for (int y = 0; y < height_m; ++y) {
      if (x % 4 == 0 || x % 4 == 3 || y % 4 == 0 || y % 4 == 3) continue;
      const auto seen = walls.at(x + 0.5, y + 0.5);
      const std::string where = std::to_string(x) + ", " + std::to_string(y);
      ASSERT_TRUE(seen) << where;
      expect_alike(*seen,
                   chequer(static_cast<std::size_t>(x * pixels_per_m),
                           static_cast<std::size_t>((height_m - y) * pixels_per_m - 1)),
                   difference, where);
    }
}

TEST_F(TexturesTest, AWallHasItsPictureAtEveryPlace) {
  write_chequer(folder / "wall.png");
  for (const double texels_per_m : {8.0, 4.0, 100.0}) {
    const Scene scene =
        bake_scene(house_of("h", wall_at("w", 0), texture_of("wall.png", "w")), texels_per_m);
    ASSERT_EQ(scene.pictures.size(), 1u);
    expect_chequer(scene, texels_per_m < pixels_per_m ? 16 : 8);
    EXPECT_EQ(report.tiles.textures.surfaces, 1u);
    EXPECT_EQ(report.tiles.textures.triangles, 2u);
    const double per_m = std::min(texels_per_m, 8.0);
    EXPECT_EQ(double(report.tiles.textures.texels), (16 * per_m + 8) * (8 * per_m + 8));
  }
}

TEST_F(TexturesTest, APartOfAPictureLiesWhereItsCoordinatesSay) {
  write_chequer(folder / "wall.png");
  // The upper right quarter of the picture, turned by half a turn: one whole field of either kind.
  const Scene scene = bake_scene(
      house_of("h", wall_at("w", 0), texture_of("wall.png", "w", "1 1 0.5 1 0.5 0.5 1 0.5 1 1")));
  const Walls walls(scene);
  expect_alike(*walls.at(4, 4), chequer(127, 0), 8, "left half");
  expect_alike(*walls.at(12, 4), chequer(65, 0), 8, "right half");
}

TEST_F(TexturesTest, APictureThatRepeatsIsLaidOutAsOften) {
  write_text(folder / "two.png", make_rgb_png(2, 1, [](std::size_t x, std::size_t) {
               return x == 0 ? light_field : dark_field;
             }));
  const Scene scene = bake_scene(
      house_of("h", wall_at("w", 0), texture_of("two.png", "w", "-1 0 1 0 1 1 -1 1 -1 0")));
  const Walls walls(scene);
  for (int i = 0; i < 4; ++i) {
    const auto seen = walls.at(4 * i + 2, 4);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->at(0) > 145, i % 2 == 0) << i;
  }
}

// A photograph has one wall in the sun and one in the shade.
TEST_F(TexturesTest, WallsOfABuildingGetTheSameMeanLuminance) {
  const auto grey = [&](const char* name, unsigned char value) {
    write_text(folder / name, make_rgb_png(64, 64, [=](std::size_t, std::size_t) {
                 return Pixel{value, value, value};
               }));
  };
  grey("sun.png", 220);
  grey("shade.png", 80);
  const Scene scene =
      bake_scene(house_of("h", wall_at("a", 0) + wall_at("b", 20),
                          texture_of("sun.png", "a") + texture_of("shade.png", "b")) +
                 house_of("dark", wall_at("c", 40), texture_of("shade.png", "c")));
  const Walls walls(scene);
  const double mean = (linear_from_srgb8(220) + linear_from_srgb8(80)) / 2;
  for (const double east : {8.0, 28.0})
    EXPECT_NEAR(walls.at(east, 4)->at(1), srgb8_from_linear(mean), 2) << east;
  EXPECT_NEAR(walls.at(48, 4)->at(1), 80, 2);  // another building keeps its own
}

TEST_F(TexturesTest, PicturesThatCannotBeUsedAreCountedByReason) {
  write_chequer(folder / "whole.png");
  const std::string png = bytes_of(folder / "whole.png");
  write_text(folder / "cut.png", png.substr(0, png.size() / 2));
  write_text(folder / "none.png", "this is no picture");
  std::string huge = png;
  huge.replace(16, 8, png_number(100'000) + png_number(100'000));
  write_text(folder / "huge.png", huge);
  std::string walls, textures;
  int n = 0;
  for (const char* name : {"cut.png", "none.png", "huge.png", "../whole.png", "absent.png",
                           "/etc/passwd", "http://example.org/whole.png"}) {
    walls += wall_at("w" + std::to_string(n), 20 * n);
    textures += texture_of(name, "w" + std::to_string(n++));
  }
  const Scene scene = bake_scene(house_of("h", walls, textures));
  EXPECT_TRUE(scene.pictures.empty());
  const auto& skipped = report.city.read.skipped;
  EXPECT_EQ(skipped.at("texture: its picture is no JPEG or PNG, or too large"), 3u);
  EXPECT_EQ(skipped.at("texture: its picture lies elsewhere"), 3u);
  EXPECT_EQ(skipped.at("texture: its picture is not there"), 1u);
}

TEST_F(TexturesTest, CoordinatesThatDoNotFitAreCountedAndTheMeanStays) {
  write_chequer(folder / "wall.png");
  const Scene scene =
      bake_scene(house_of("h", wall_at("a", 0) + wall_at("b", 20) + wall_at("c", 40),
                          texture_of("wall.png", "a", "0 0 1 0 1 1 0 0") +
                              texture_of("wall.png", "b", "0 0 1e9 0 1e9 1 0 1 0 0") +
                              texture_of("wall.png", "c", "0 0 1 0 1 one 0 1 0 0")));
  EXPECT_TRUE(scene.pictures.empty());
  const auto& skipped = report.city.read.skipped;
  EXPECT_EQ(
      skipped.at("texture: a ring has another number of texture coordinates than of vertices"), 1u);
  EXPECT_EQ(skipped.at("texture: its place in the picture is no number, or its object has too many "
                       "pixels"),
            1u);
}

TEST_F(TexturesTest, CityGml3NamesRingsInElements) {
  write_chequer(folder / "wall.png");
  const std::string texture =
      "<app:surfaceData><app:ParameterizedTexture><app:imageURI>wall.png</app:imageURI>"
      "<app:textureParameterization><app:TextureAssociation><app:target>#w</app:target>"
      "<app:textureParameterization><app:TexCoordList><app:textureCoordinates>0 0 1 0 1 1 0 1 0 0"
      "</app:textureCoordinates><app:ring>#w_ring</app:ring></app:TexCoordList>"
      "</app:textureParameterization></app:TextureAssociation></app:textureParameterization>"
      "</app:ParameterizedTexture></app:surfaceData>";
  expect_chequer(bake_scene(house_of("h", wall_at("w", 0), texture)));
}

TEST_F(TexturesTest, AnAppearanceOfTheDocumentDressesItsBuildings) {
  write_chequer(folder / "wall.png");
  expect_chequer(bake_scene(house_of("h", wall_at("w", 0), "") +
                            "<app:appearanceMember><app:Appearance>" + texture_of("wall.png", "w") +
                            "</app:Appearance></app:appearanceMember>"));
}

// Each wall of 16 by 8 m has 100 texels a metre along a side: 1.28 megatexels.
TEST_F(TexturesTest, BeyondTheLimitOfTexelsSurfacesKeepTheMeanColourAndAreCounted) {
  constexpr int larger = 2048;
  write_text(folder / "even.png", make_rgb_png(larger, larger / 2, [](std::size_t, std::size_t) {
               return light_field;
             }));
  std::string members;
  for (int i = 0; i < 4; ++i) {
    const std::string id = "w" + std::to_string(i);
    members += house_of("h" + std::to_string(i), wall_at(id, 20 * i), texture_of("even.png", id));
  }
  max_picture_mpx = 3;
  const Scene scene = bake_scene(members, 100);
  EXPECT_EQ(report.tiles.textures.surfaces, 2u);
  EXPECT_EQ(report.tiles.textures.beyond_limit, 2u);
  EXPECT_LT(report.tiles.textures.texels, 3'000'000u);
  std::size_t plain = 0;
  for (const SceneMesh& mesh : scene.meshes)
    for (const ScenePrimitive& p : mesh.primitives)
      if (p.texture_coordinates.empty()) plain += p.indices.size() / 3;
  EXPECT_EQ(plain, 4u);  // two triangles for each wall without a picture
  EXPECT_GT(report.tiles.colours, 0u);
  max_picture_mpx = 6;
  bake_scene(members, 100);
  EXPECT_EQ(report.tiles.textures.surfaces, 4u);
  EXPECT_EQ(report.tiles.textures.beyond_limit, 0u);
}

TEST_F(TexturesTest, PartsGiveTheBytesOfTheWhole) {
  write_chequer(folder / "wall.png");
  std::string members;
  for (int n = 0; n < 300; ++n) {
    const std::string id = std::to_string(n);
    members += house_of("h" + id, wall_at("w" + id, 20 * n), texture_of("wall.png", "w" + id));
  }
  write_text(folder / "city.gml", city_model(members));
  write_text(folder / "city.toml",
             "[city]\nfiles = [\"city.gml\"]\ntextures = \"atlas\"\ntexels_per_m = 3\n");
  expect_parts_as_whole(folder / "city.toml", folder.path(), {1, 3, 8});
  EXPECT_GT(read_scene(folder / "whole" / "city.glb").pictures.size(), 10u);
}

TEST(Atlas, PiecesDoNotOverlapAndEdgesGoOnAroundThem) {
  std::vector<PicturePiece> pieces;
  for (int i = 0; i < 300; ++i) {
    PicturePiece piece{static_cast<std::uint16_t>(1 + i * 37 % 200),
                       static_cast<std::uint16_t>(1 + i * 53 % 170),
                       {}};
    piece.rgb.assign(std::size_t{3} * piece.width * piece.height,
                     static_cast<std::uint8_t>(50 + i % 5 * 40));
    pieces.push_back(std::move(piece));
  }
  pieces.push_back({3000, 2, std::vector<std::uint8_t>(18000, 200)});
  const Atlases atlases = pack_atlases(pieces);
  std::vector<std::optional<Picture>> pictures;
  for (const ScenePicture& picture : atlases.pictures) {
    pictures.push_back(Picture::read(picture));
    ASSERT_TRUE(pictures.back());
  }
  std::vector<std::vector<int>> owner;
  for (const glm::ivec2& size : atlases.sizes)
    owner.emplace_back(static_cast<std::size_t>(size.x * size.y), -1);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto& [number, corner] = atlases.places[i];
    EXPECT_EQ(corner.x % atlas_margin, 0);
    EXPECT_EQ(corner.y % atlas_margin, 0);
    const Picture& picture = *pictures[number];
    for (int y = corner.y - atlas_margin; y < corner.y + pieces[i].height + atlas_margin; ++y)
      for (int x = corner.x - atlas_margin; x < corner.x + pieces[i].width + atlas_margin; ++x) {
        int& who = owner[number].at(static_cast<std::size_t>(y * atlases.sizes[number].x + x));
        ASSERT_EQ(who, -1);
        who = static_cast<int>(i);
      }
    const auto middle = static_cast<std::size_t>(
        (corner.y + pieces[i].height / 2) * picture.width() + corner.x + pieces[i].width / 2);
    EXPECT_NEAR(picture.pixels()[4 * middle], pieces[i].rgb[0], 12) << i;
  }
}

TEST(Textures, ARealCityHasThemOnMostOfItsSurfaces) {
  REAL_DATA(file, "berlin/textured/export.gml");
  const TempFolder folder;
  Recipe recipe;
  recipe.city.files = {file};
  recipe.city.read.textures = city::Textures::atlas;
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_GT(report.tiles.textures.surfaces, 100u);
  const Scene scene = read_scene(folder / "out" / "city.glb");
  EXPECT_EQ(scene.pictures.size(), report.tiles.textures.pictures);
  for (const ScenePicture& picture : scene.pictures) EXPECT_TRUE(Picture::read(picture));
}

}  // namespace
}  // namespace nightcity::bake
