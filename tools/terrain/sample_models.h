// Heights from several elevation models, such as the tiles of one survey.
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "tools/terrain/elevation_model.h"

namespace nightcity::terrain {

/// Fills `heights` (m) from the first model that has a height between the centres of its pixels.
/// Beyond these, as far as a raster reaches, heights of all models there are mixed by their
/// weights, so that tiles without an overlap have no step between them. NaN where no model has one.
/// Each place is given twice: in the city's coordinates, for models without a CRS, and in WGS 84
/// longitude and latitude for the others. Throws Error when a model cannot be read.
void sample_models(std::span<const ElevationModel> models, std::span<const glm::dvec2> places,
                   std::span<const glm::dvec2> lon_lat, std::span<double> heights);

}  // namespace nightcity::terrain
