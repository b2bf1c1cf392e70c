// Colours as an eye that is adapted to the scene sees them.

// Returns the scotopic luminance of linear Rec. 709 light, cd/m^2, by Ward Larson, Rushmeier,
// Piatko: A visibility matching tone reproduction operator for high dynamic range scenes, 1997.
float scotopic_luminance(vec3 rgb) {
  const float x = dot(rgb, vec3(0.4124, 0.3576, 0.1805)), y = luminance(rgb),
              z = dot(rgb, vec3(0.0193, 0.1192, 0.9505));
  // The fit has no meaning beyond the S/P ratios of real light.
  return y * clamp(1.33 * (1.0 + (y + z) / max(x, 1e-30)) - 1.68, 0.0, 5.0);
}

// Returns the adaptation coefficient m of light of a photopic and a scotopic luminance, 0 (rods
// alone) .. 1 (cones alone), and the mesopic luminance: the system MES2 of CIE 191:2010.
float mesopic_coefficient(float photopic, float scotopic, out float mesopic) {
  const float rods = 683.0 / 1699.0;  // V'(555 nm)
  float m = 0.5;
  mesopic = photopic;
  for (int i = 0; i < 8; ++i) {  // the iteration of the standard
    mesopic = (m * photopic + (1.0 - m) * scotopic * rods) / (m + (1.0 - m) * rods);
    m = clamp(0.7670 + 0.3334 * log(max(mesopic, 1e-30)) / log(10.0), 0.0, 1.0);
  }
  return m;
}

// Returns light, cd/m^2 per channel, as it is seen: adapted to the scene's white, and in dim places
// with the rods' part in it. Rods see no colour; their light looks bluish (1.05, 0.97, 1.27;
// Durand, Dorsey: Interactive tone mapping, 2000, after Hunt). A pixel is adapted to its own
// luminance, as the fovea is (Ward Larson et al.).
vec3 seen_by_eye(vec3 light) {
  vec3 seen = light;
  if (WHITE != 0u)
    seen = max(vec3(dot(FRAME.white_red, light), dot(FRAME.white_green, light),
                    dot(FRAME.white_blue, light)),
               vec3(0.0));
  if (MESOPIC == 0u) return seen;
  float mesopic;
  const float m = mesopic_coefficient(luminance(light), scotopic_luminance(light), mesopic);
  return mix(mesopic * vec3(1.05, 0.97, 1.27), seen, m);
}
