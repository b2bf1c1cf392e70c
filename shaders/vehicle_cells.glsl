// The cells of the map by which vehicles are sorted, in Morton order.

uint vehicle_cells() { return SCENE.traffic.cells_per_side * SCENE.traffic.cells_per_side; }

uint spread_bits(uint x) {  // 8 bits to every second bit
  x = (x | x << 4u) & 0x0F0Fu;
  x = (x | x << 2u) & 0x3333u;
  return (x | x << 1u) & 0x5555u;
}

uint vehicle_cell(vec3 p) {
  const vec3 lower = SCENE.traffic.lower, extent = max(SCENE.traffic.upper - lower, vec3(1.0));
  const float side = float(SCENE.traffic.cells_per_side);
  const uvec2 at = uvec2(clamp((p.xz - lower.xz) / extent.xz * side, vec2(0.0), vec2(side - 1.0)));
  return spread_bits(at.x) | spread_bits(at.y) << 1u;
}
