// Ground that has steps.

// The direction of a layer, and the layer of an azimuth.
vec2 axisOf(int layer) {
  vec2 axis = layer % 2 == 0 ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
  return layer < 2 ? axis : -axis;
}
int layerOf(float azimuth) { return int(round(azimuth / (0.5 * pi))) % 4; }

// The way to where the ground has risen, and the rise; 0 where it does not.
vec2 nextStep(vec2 texel, vec2 direction, int most) {
  float own = heightAt(texel);
  for (int k = 1; k <= most; ++k) {
    float rise = heightAt(texel + float(k) * direction) - own;
    if (rise > 0.0) return vec2(float(k), rise);
  }
  return vec2(0.0);
}
