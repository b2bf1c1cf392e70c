// The denoiser is an edge-avoiding a-trous filter guided by variance (Dammertz et al., HPG 2010;
// Schied et al.: Spatiotemporal Variance-Guided Filtering, HPG 2017). It works on light divided by
// albedo.

// Returns a surface's albedo, bounded below so that dividing by it does not blow up what little
// light there is.
vec3 albedo_of(Surface surface) {
  return max(base_colour_of(surface.material), vec3(0.01));
}
