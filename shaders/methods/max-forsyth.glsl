/* gnomon-method
title = "Flat horizon map"
citation = "Max 1988; Forsyth 2003"
family = "flat"
symbol = "circle"
tables = ["horizon"]
*/

// Lit where the light stands higher than the horizon of the flat relief in its azimuth:
// tan θ > tan β. The table holds δ in height units per texel, so that tan β = a δ / σ.

float horizonSlope(Pixel pixel, LocalLight light) {
  return pixel.worldPerHeight * horizonAt(pixel.texel, light.azimuth) / light.worldPerTexel;
}
