// Horizon and distance tables: one layer an azimuth φ_m = 2πm/M, linear in all three axes (Forsyth
// 2003). A method sees the tables it declares and no others.

#if defined(TABLE_HORIZON) || defined(TABLE_DISTANCE) || defined(TABLE_ELLIPSE)

// The stored value of one texel and azimuth: codes are normalised, range = (low, high - low).
float tableEntry(sampler3D table, vec2 range, ivec2 at, int azimuth) {
  ivec3 size = textureSize(table, 0);
  return range.x + range.y * texelFetch(table, ivec3(wrapTexel(at, size.xy), azimuth % size.z), 0).r;
}

float tableLayer(sampler3D table, vec2 range, vec2 at, int azimuth) {
  vec2 corner = floor(at - 0.5);
  vec2 fraction = at - 0.5 - corner;
  ivec2 i = ivec2(corner);
  float low = mix(tableEntry(table, range, i, azimuth),
                  tableEntry(table, range, i + ivec2(1, 0), azimuth), fraction.x);
  float high = mix(tableEntry(table, range, i + ivec2(0, 1), azimuth),
                   tableEntry(table, range, i + ivec2(1, 1), azimuth), fraction.x);
  return mix(low, high, fraction.y);
}

float tableAt(sampler3D table, vec2 range, vec2 at, float azimuth) {
  ivec3 size = textureSize(table, 0);
#ifdef FILTER_HARDWARE
  float layer = azimuth / (2.0 * pi) + 0.5 / float(size.z);
  return range.x + range.y * texture(table, vec3(at / vec2(size.xy), layer)).r;
#else
  float place = azimuth / (2.0 * pi) * float(size.z);
  int below = int(floor(place));
  return mix(tableLayer(table, range, at, below), tableLayer(table, range, at, below + 1),
             place - floor(place));
#endif
}

#endif

#ifdef TABLE_HORIZON
uniform sampler3D horizonTable;
uniform vec2 horizonRange;

// δ: tangent of the horizon angle, height units per texel.
float horizonAt(vec2 at, float azimuth) { return tableAt(horizonTable, horizonRange, at, azimuth); }
#endif

#ifdef TABLE_DISTANCE
uniform sampler3D distanceTable;
uniform vec2 distanceRange;

// d: distance to the horizon point, texels.
float distanceAt(vec2 at, float azimuth) {
  return tableAt(distanceTable, distanceRange, at, azimuth);
}
#endif

#ifdef TABLE_ELLIPSE
uniform sampler3D ellipseTable;
uniform vec2 ellipseRange;

// An elliptical cone of light: |A⁻¹ (l - c)| ≤ 1 for the light's direction l on the tangent plane.
struct Ellipse {
  vec2 centre;  // c
  mat2 spread;  // A, symmetric
};

Ellipse ellipseAt(vec2 at) {
  float entry[5];
  for (int k = 0; k < 5; ++k) entry[k] = tableLayer(ellipseTable, ellipseRange, at, k);
  return Ellipse(vec2(entry[0], entry[1]), mat2(entry[2], entry[3], entry[3], entry[4]));
}
#endif
