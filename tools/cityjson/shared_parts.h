// The parts that the city objects of a document share: CRS, transformation, templates, materials.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/city/picture_shelf.h"
#include "tools/city/skip_counter.h"
#include "tools/cityjson/json.h"

namespace nightcity::cityjson {

/// Turns the integers that vertices are stored as into coordinates.
struct Transform {
  glm::dvec3 scale{1}, translate{0};

  glm::dvec3 apply(const glm::dvec3& stored) const { return stored * scale + translate; }
};

/// The diffuse colours of an "appearance", sRGB from 0 to 1, and its textures.
struct Materials {
  std::vector<std::optional<glm::vec3>> colours;
  std::string default_theme, default_texture_theme;
  std::vector<std::string> picture_names;
  std::vector<glm::dvec2> texture_places;        // "vertices-texture"; not finite where none
  std::shared_ptr<city::PictureShelf> pictures;  // null: textures are not read
  city::Textures textures = city::Textures::none;

  void read(const dom::object& appearance);
  /// Looks for the pictures beside the document where `options` ask for them; otherwise counts
  /// them.
  void find_pictures(const std::string& document, const city::ReadOptions& options,
                     city::SkipCounter& skipped);
};

/// Returns file and line.
using Where = std::function<std::string()>;

/// Reads a "transform". Throws Error where it is none.
Transform read_transform(const dom::element& value, const Where& where);

struct SharedParts {
  std::string version;   // "2.0"
  std::string srs_name;  // "EPSG:7415", from any of the forms in use; "" = none
  bool has_transform = false;
  Transform transform;
  Materials materials;
  std::vector<std::optional<dom::object>> templates;  // geometries; none: broken
  std::vector<glm::dvec3> template_vertices;

  /// Takes one member of a CityJSON object; those that say nothing about the whole are passed over.
  /// `where` returns file and place, for messages alone: to count the lines before takes as long as
  /// to read them. Throws Error where "type" is not CityJSON, the version is none of 1.0 to 2.0, or
  /// the transformation is none.
  void read(std::string_view key, const dom::element& value, const Where& where,
            city::SkipCounter& skipped);
  /// Throws Error unless `type` and `version` have been read.
  void require_type(const std::string& where) const;
  /// Throws Error where the document names another CRS than `known`, by which the caller takes its
  /// file's coordinates: then the file is an archive of documents that differ. Absent: not
  /// compared.
  void require_srs_name(const std::optional<std::string>& known, const std::string& where) const;

 private:
  void read_templates(const dom::object& value);
  bool has_type_ = false;
};

/// Returns "EPSG:7415" for "https://www.opengis.net/def/crs/EPSG/0/7415",
/// "urn:ogc:def:crs:EPSG::7415" and the like, other names as they are. The form of the name thus
/// promises no axis order: CityJSON writes x, y, z, which is easting or longitude first, whatever
/// the register says.
std::string to_srs_name(std::string_view reference_system);
/// Returns the name of a CRS that is an object: its code or else all of its text where it is
/// PROJJSON, the name in it where it has the form of GeoJSON's crs member; "" for others.
std::string find_crs_name(const dom::object& described);

/// Returns the vertices of an array, in the city's CRS. A vertex that is none becomes one that is
/// not finite, so that the polygons that need it are left out.
std::vector<glm::dvec3> read_vertices(const dom::array& array, const Transform& transform);

}  // namespace nightcity::cityjson
