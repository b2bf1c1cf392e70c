#include "tools/terrain/height_unit.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "formats/error.h"
#include "formats/to_lower.h"

namespace nightcity::terrain {
namespace {

struct Unit {
  std::string_view name;  // in lower case
  double metres;
};

constexpr double us_survey_foot = 1200.0 / 3937.0;

// Names of units as GDAL's formats and producers write them.
constexpr std::array units{
    Unit{"m", 1},
    Unit{"metre", 1},
    Unit{"metres", 1},
    Unit{"meter", 1},
    Unit{"meters", 1},
    Unit{"mm", 0.001},
    Unit{"millimetre", 0.001},
    Unit{"millimeter", 0.001},
    Unit{"cm", 0.01},
    Unit{"centimetre", 0.01},
    Unit{"centimeter", 0.01},
    Unit{"centimetres", 0.01},
    Unit{"centimeters", 0.01},
    Unit{"dm", 0.1},
    Unit{"decimetre", 0.1},
    Unit{"decimeter", 0.1},
    Unit{"km", 1000},
    Unit{"kilometre", 1000},
    Unit{"kilometer", 1000},
    Unit{"ft", 0.3048},
    Unit{"foot", 0.3048},
    Unit{"feet", 0.3048},
    Unit{"international foot", 0.3048},
    Unit{"international feet", 0.3048},
    Unit{"us survey foot", us_survey_foot},
    Unit{"us survey feet", us_survey_foot},
    Unit{"us_survey_foot", us_survey_foot},
    Unit{"u.s. survey foot", us_survey_foot},
    Unit{"foot_us", us_survey_foot},
    Unit{"us-ft", us_survey_foot},
    Unit{"us-foot", us_survey_foot},
    Unit{"us foot", us_survey_foot},
    Unit{"us feet", us_survey_foot},
    Unit{"usft", us_survey_foot},
    Unit{"us ft", us_survey_foot},
    Unit{"ftus", us_survey_foot},
    Unit{"sft", us_survey_foot},
    Unit{"yd", 0.9144},
    Unit{"yard", 0.9144},
};

}  // namespace

double find_height_unit(GDALRasterBand& band, const OGRSpatialReference* crs,
                        const std::string& file) {
  const std::string said = to_lower(band.GetUnitType());
  if (!said.empty() && said != "unknown") {
    const auto unit =
        std::find_if(units.begin(), units.end(), [&](const Unit& u) { return u.name == said; });
    if (unit == units.end())
      throw Error(file, "its heights are in the unit \"" + said + "\", which is not known here");
    return unit->metres;
  }
  if (!crs || !crs->IsCompound()) return 1;
  const double metres = crs->GetTargetLinearUnits("VERT_CS");
  return metres > 0 ? metres : 1;
}

}  // namespace nightcity::terrain
