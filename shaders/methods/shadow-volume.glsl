/* gnomon-method
title = "Displaced mesh with shadow volumes"
citation = "Crow 1977, z-fail; Onoue, Max & Nishita 2004, Figure 8(c)"
family = "displaced"
symbol = "circle"
passes = ["shadow-volumes"]
mesh = "displaced"
subdivisions = 9
*/

// The surface as real geometry, 9 × 9 quadrilaterals for each one of the base mesh as in the paper
// (960 · 81 = 77,760 triangles), with exact shadows of that geometry: its error is the mesh's.

bool isShadowed(Pixel pixel, LocalLight light) { return shadowCount() != 0u; }
