// An edge-avoiding a-trous filter guided by variance (Dammertz et al., HPG 2010; Schied et al.: Spatiotemporal
// Variance-Guided Filtering, HPG 2017), on light over albedo.

// Never so dark that dividing by it blows up what little light there is.
vec3 albedo_of(Surface surface) { return max(SCENE.materials.at[surface.material].base_colour, vec3(0.01)); }
