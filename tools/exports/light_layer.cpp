#include "tools/exports/light_layer.h"

#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/signals.h"
#include "formats/to_lower.h"
#include "tools/exports/light_texts.h"
#include "tools/gdal/guarded_gdal.h"

namespace nightcity::exports {
namespace {

struct LayerFormat {
  const char *driver, *ending;
};

LayerFormat find_format(const std::filesystem::path& path) {
  const std::string ending = to_lower(path.extension().string());
  if (ending == ".gpkg") return {"GPKG", ".gpkg"};
  if (ending == ".fgb") return {"FlatGeobuf", ".fgb"};
  throw Error(path.string(), "ends neither with .gpkg (GeoPackage) nor with .fgb (FlatGeobuf)");
}

struct Column {
  const char* name;
  OGRFieldType type;
};
// In the order in which add_row fills them.
constexpr Column columns[] = {
    {"light", OFTInteger64},      {"id", OFTInteger64},        {"family", OFTString},
    {"kind", OFTString},          {"flux_lm", OFTReal},        {"colour", OFTString},
    {"axis_east", OFTReal},       {"axis_north", OFTReal},     {"axis_up", OFTReal},
    {"radius_m", OFTReal},        {"width_m", OFTReal},        {"height_m", OFTReal},
    {"profile", OFTInteger64},    {"hours", OFTString},        {"source_id", OFTString},
    {"position_from", OFTString}, {"height_from", OFTString},  {"flux_from", OFTString},
    {"colour_from", OFTString},   {"profile_from", OFTString}, {"hours_from", OFTString},
};

// A file that GDAL makes, removed unless it was renamed.
struct NamedScratch {
  explicit NamedScratch(std::filesystem::path name)
      : path(std::move(name)), leftover(path, Leftover::Kind::file) {}
  NamedScratch(const NamedScratch&) = delete;
  NamedScratch& operator=(const NamedScratch&) = delete;
  ~NamedScratch() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  std::filesystem::path path;
  Leftover leftover;
};

class LayerWriter {
 public:
  LayerWriter(const LightFile& file, const std::filesystem::path& scratch, const char* driver,
              std::string name)
      : file_(file), name_(std::move(name)) {
    GDALDriver* made_by = GetGDALDriverManager()->GetDriverByName(driver);
    if (!made_by) throw Error(name_, std::string("this GDAL has no driver for ") + driver);
    dataset_.reset(made_by->Create(scratch.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!dataset_) fail();
    OGRSpatialReference crs;
    const std::string& definition = file.georeference().crs;
    if (!definition.empty()) {
      if (crs.SetFromUserInput(definition.c_str()) != OGRERR_NONE)
        throw Error(name_, "GDAL does not know the scene's CRS: " + definition);
      crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    }
    layer_ =
        dataset_->CreateLayer("lights", definition.empty() ? nullptr : &crs, wkbPoint25D, nullptr);
    if (!layer_) fail();
    for (const Column& column : columns) {
      OGRFieldDefn field(column.name, column.type);
      if (layer_->CreateField(&field) != OGRERR_NONE) fail();
    }
  }

  void write() {
    dataset_->StartTransaction();
    for (std::size_t i = 0; i < file_.lights().size(); ++i) add_row(i);
    if (dataset_->CommitTransaction() != OGRERR_NONE && layer_->TestCapability(OLCTransactions))
      fail();
    CPLErrorReset();
    GDALClose(dataset_.release());  // writes what is left
    if (CPLGetLastErrorType() == CE_Failure) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(name_, "cannot be written: " + gdal::find_reason());
  }

  void add_row(std::size_t index) {
    const Light& light = file_.lights()[index];
    const LightProvenance from =
        index < file_.provenance().size() ? file_.provenance()[index] : LightProvenance{};
    OGRFeatureUniquePtr row(OGRFeature::CreateFeature(layer_->GetLayerDefn()));
    int column = 0;
    const auto put = [&](auto value) { row->SetField(column++, value); };
    const auto put_text = [&](const std::string& value) { put(value.c_str()); };
    const bool sphere = light_kind(light) == LightKind::sphere;
    put(static_cast<GIntBig>(index));
    put(static_cast<GIntBig>(light.id));
    put(name_of(static_cast<LightFamily>(from.family)));
    put(name_of(light_kind(light)));
    put(static_cast<double>(light.flux_lm));
    put_text(to_hex_colour(light));
    put(static_cast<double>(light.axis.x));
    put(static_cast<double>(-light.axis.z));
    put(static_cast<double>(light.axis.y));
    if (sphere) row->SetField(column, static_cast<double>(light.radius));
    ++column;
    if (!sphere) row->SetField(column, 2.0 * half_width(light));
    ++column;
    if (!sphere) row->SetField(column, 2.0 * light.half_height);
    ++column;
    if (light_profile(light) != LIGHT_NO_PROFILE)
      row->SetField(column, static_cast<GIntBig>(light_profile(light)));
    ++column;
    put_text(describe_hours(file_, light));
    put_text(std::to_string(from.source_id));
    for (const ValueSource source :
         {from.position, from.height, from.flux, from.colour, from.profile, from.schedule})
      put(name_of(source));
    const glm::dvec3 place = file_.georeference().from_model(glm::dvec3(light.position));
    OGRPoint point(place.x, place.y, place.z);
    row->SetGeometry(&point);
    if (layer_->CreateFeature(row.get()) != OGRERR_NONE) fail();
  }

  const LightFile& file_;
  std::string name_;
  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
};

}  // namespace

std::size_t write_light_layer(const LightFile& lights, const std::filesystem::path& path) {
  const LayerFormat format = find_format(path);
  gdal::register_drivers();
  const gdal::Guard guard;
  AtomicPath output(path);
  // GDAL goes by the ending: a FlatGeobuf of another name becomes a folder.
  const NamedScratch made(output.scratch().string() + format.ending);
  LayerWriter(lights, made.path, format.driver, path.string()).write();
  std::filesystem::rename(made.path, output.scratch());
  output.commit();
  return lights.lights().size();
}

}  // namespace nightcity::exports
