/* gnomon-method
title = "Bump mapping alone"
citation = "Blinn 1978"
family = "control"
symbol = "circle"
*/

// No bump casts a shadow: only what bump mapping itself turns from the light is dark in its picture.
// The control that every gate must fail.

bool isShadowed(Pixel pixel, LocalLight light) { return false; }
