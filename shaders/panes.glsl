// The camera sees a frame in a lit window, curtains or a blind, and the room behind them, and in the
// dark it sees what the glass mirrors. The window stays one light that shines evenly. What is seen
// has the light's luminance in its mean over the window, from wherever it is seen.
//   The room is a box of usual size whose walls have tones (interior mapping: van Dongen, Interior
// mapping, CGI 2008). Every part is a product of a function along the window and one upwards, so
// that the mean over the window, and over a pixel, is a product of two sums.

// A frame's bars, m: casements seldom have wider ones (60 to 90 mm of wood or plastic).
const float FRAME_M = 0.06, BAR_M = 0.07;
// A field of glass is no wider than this, that of a shop's window no wider than the second.
const float FIELD_M = 1.2, SHOP_FIELD_M = 2.5, SHOP_M = 3.0;
// A window higher than this has a bar across, which parts its upper quarter.
const float TRANSOM_M = 1.6;
// The room: its depth, how far it reaches beyond the window to the sides, below and above.
const float ROOM_DEPTH_M = 4.0, ROOM_BESIDE_M = 1.0, SILL_M = 0.9, LINTEL_M = 0.4;
// Tones of what is seen through the glass, as multiples of the back wall's luminance: a lamp hangs
// from a white ceiling, floors are darker. And of cloth that hangs before it.
const float CEILING_TONE = 1.3, FLOOR_TONE = 0.5, SIDE_TONE = 0.8, CLOTH_TONE = 0.45;

// A window along one of its sides. Places count from its lower left corner, seen from outside, m.
struct PaneSide {
  float size_m;
  float fields;        // of glass
  float first_m;       // the end of the first field, where they are not equal; 0 = they are
  vec2 open_m;         // from where to where no cloth hangs
  vec2 back_m;         // through which part the back wall is seen
  float before, behind;  // tones of what is seen below and above that part
};

float overlap(vec2 a, vec2 b) { return max(min(a.y, b.y) - max(a.x, b.x), 0.0); }

// Returns the integral over a field of glass, or a part of it, of what is seen there.
float integrate_field(PaneSide side, vec2 part) {
  const vec3 tones = vec3(side.before, 1.0, side.behind);
  float sum = 0.0;
  for (int zone = 0; zone < 3; ++zone) {
    const vec2 ends = zone == 0   ? vec2(-1e9, side.back_m.x)
                      : zone == 1 ? side.back_m
                                  : vec2(side.back_m.y, 1e9);
    const vec2 seen = vec2(max(part.x, ends.x), min(part.y, ends.y));
    const float all = max(seen.y - seen.x, 0.0);
    sum += tones[zone] * mix(overlap(seen, side.open_m), all, CLOTH_TONE);
  }
  return sum;
}

// Returns the integral over a part of a side; the frame counts as nothing.
float integrate_side(PaneSide side, vec2 part) {
  const float inner_m = side.size_m - 2.0 * FRAME_M;
  // A frame that took more than half would leave a slit with the light of all of it.
  if (inner_m < 0.5 * side.size_m) return max(part.y - part.x, 0.0);
  const float field_m = (inner_m - BAR_M * (side.fields - 1.0)) / side.fields;
  float sum = 0.0;
  for (float i = 0.0; i < side.fields; i += 1.0) {
    vec2 field = FRAME_M + vec2(i, i) * (field_m + BAR_M) + vec2(0.0, field_m);
    if (side.first_m > 0.0)
      field = i == 0.0 ? vec2(FRAME_M, side.first_m)
                       : vec2(side.first_m + BAR_M, side.size_m - FRAME_M);
    sum += integrate_field(side, vec2(max(field.x, part.x), min(field.y, part.y)));
  }
  return sum;
}

// Returns the integral over a pixel's part of a side, per metre. What would lie beyond an end is
// folded back, which keeps the mean over all pixels.
float mean_at(PaneSide side, float at_m, float footprint_m) {
  const float width_m = min(max(footprint_m, 1e-3), side.size_m);
  const float low = at_m - 0.5 * width_m, high = at_m + 0.5 * width_m, end = side.size_m;
  return (integrate_side(side, vec2(max(low, 0.0), min(high, end))) +
          integrate_side(side, vec2(0.0, -low)) +
          integrate_side(side, vec2(2.0 * end - high, end))) /
         width_m;
}

// Returns the mean there as a multiple of that over all of a side.
float compare_side(PaneSide side, float at_m, float footprint_m) {
  const float all = integrate_side(side, vec2(0.0, side.size_m));
  return all > 0.0 ? mean_at(side, at_m, footprint_m) * side.size_m / all : 1.0;
}

// Returns which part of a pixel's part of a side is glass.
float find_glass(PaneSide side, float at_m, float footprint_m) {
  side.open_m = side.back_m = vec2(-1e9, 1e9);
  side.before = side.behind = 1.0;
  return mean_at(side, at_m, footprint_m);
}

// Returns what is seen at a place of a window along unit `to` (away from it): with `lit` its
// luminance as a multiple of the light's, else the part of the pixel that is glass. `footprint_m` is
// the width of a pixel there.
float look_at_pane(Light light, vec3 place, vec3 to, float footprint_m, bool lit) {
  const vec3 up = cross(light.axis, light.tangent), from_middle = place - light.position;
  const vec2 size_m = 2.0 * vec2(half_width(light), light.half_height);
  const vec2 at_m = vec2(dot(from_middle, light.tangent), dot(from_middle, up)) + 0.5 * size_m;
  const float cosine = max(dot(light.axis, to), 0.05), width_m = footprint_m / cosine;
  if (lit && width_m >= max(size_m.x, size_m.y)) return 1.0;
  // By how much a ray goes on along the window and upwards until it is at the back of the room.
  const vec2 slant_m = -ROOM_DEPTH_M / cosine * vec2(dot(light.tangent, to), dot(up, to));

  PaneSide across, upright;
  across.size_m = size_m.x;
  upright.size_m = size_m.y;
  across.fields = clamp(ceil(size_m.x / (size_m.x > SHOP_M ? SHOP_FIELD_M : FIELD_M)), 1.0, 8.0);
  across.first_m = 0.0;
  upright.fields = size_m.y > TRANSOM_M ? 2.0 : 1.0;
  upright.first_m = size_m.y > TRANSOM_M ? 0.75 * size_m.y : 0.0;
  if (!lit) return find_glass(across, at_m.x, width_m) * find_glass(upright, at_m.y, width_m);
  across.back_m = vec2(-ROOM_BESIDE_M, size_m.x + ROOM_BESIDE_M) - slant_m.x;
  upright.back_m = vec2(-SILL_M, size_m.y + LINTEL_M) - slant_m.y;
  across.before = across.behind = SIDE_TONE;
  upright.before = FLOOR_TONE;
  upright.behind = CEILING_TONE;
  across.open_m = upright.open_m = vec2(-1e9, 1e9);
  // One window in four shows its room, one has curtains to both sides, one has a blind, and one is
  // covered by cloth.
  const uint draw = pcg4d(uvec4(light.id, 0u, 0u, 0u)).x;
  const float chance = float(draw >> 16u) / 65536.0;
  switch (draw & 3u) {
    case 0u: break;
    case 1u: across.open_m = size_m.x * vec2(0.12 + 0.12 * chance, 0.88 - 0.12 * chance); break;
    case 2u: upright.open_m.y = size_m.y * (0.35 + 0.5 * chance); break;
    default:
      across.before = across.behind = upright.before = upright.behind = 1.0;
      across.open_m = upright.open_m = vec2(0.0);
  }
  return compare_side(across, at_m.x, width_m) * compare_side(upright, at_m.y, width_m);
}

// Returns what a window's glass mirrors, cd/m^2 per channel: the sky, and what shines. Surfaces that
// are lit are left out. Two faces of glass reflect (refractive index 1.5, Schlick's Fresnel term).
vec3 mirrored_in_pane(vec3 origin, vec3 normal, vec3 to) {
  const float cosine = clamp(dot(normal, to), 0.0, 1.0);
  const float face = 0.04 + 0.96 * pow(1.0 - cosine, 5.0), pane = 2.0 * face / (1.0 + face);
  const vec3 direction = reflect(-to, normal);
  Hit hit;
  const Surface mirrored = first_surface(origin, direction, MASK_VISIBLE, WIDE_SPREAD, hit);
  if (mirrored.depth <= 0.0)
    return SKY_MODE == SKY_DARK ? vec3(0.0) : pane * sky_luminance(direction);
  const vec3 own = emission_of(mirrored.material);
  if (luminance(own) <= 0.0) return vec3(0.0);
  return pane * (mirrored.light < SCENE.light_count
                     ? seen_luminance(light_at(mirrored.light), -direction)
                     : own);
}

// Windows that are this many pixels high and wide mirror: of smaller ones nobody sees what.
const float MIRROR_PIXELS = 2.0;

// Returns the light that comes from a surface to the camera without having been scattered there,
// cd/m^2 per channel: what it emits, or what the glass of a dark window mirrors. That of a lit one
// is a hundredth of its own light.
vec3 seen_emission(Surface surface) {
  const vec3 seen = emitted(surface);
  if (HAS_RECTANGLES == 0u || surface.light >= SCENE.light_count || !is_pane(surface.material))
    return seen;
  const Light light = light_at(surface.light);
  const vec3 normal = unpack_normal(surface.normal, surface.clearance_and_rest),
             to = normalize(FRAME.camera.position - surface.position);
  if (kind_here(light) != LIGHT_RECTANGLE || dot(normal, light.axis) <= 0.0) return seen;
  const bool lit = luminance(seen) > 0.0;
  const float pixel_m = pixel_spread() * surface.depth,
              size_m = 2.0 * min(half_width(light), light.half_height);
  if (!lit && MIRROR_PIXELS * pixel_m > size_m * dot(light.axis, to)) return seen;
  const float look = look_at_pane(light, surface.position, to, pixel_m, lit);
  if (lit) return look * seen;
  return look > 0.0 ? look * mirrored_in_pane(surface.position + normal * clearance_of(surface),
                                              normal, to)
                    : seen;
}
