/* Mechanical parts, after the paper's Figure 10: crankshaft, hand crank and turbine rotor together.
 * Surfaces: 73 + 20 + 351. Trims: 64 + 18. */
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 }
#include "crank.inc"
#include "crank1a.inc"
#include "allblade.inc"

camera { location <-3, 16, -22> look_at <.35, 2.1, 1.2> angle 37 right x * image_width / image_height }
background { rgb <.16, .18, .22> }
light_source { <-18, 22, -12>, rgb <.95, .93, .88> }
light_source { <14, 14, -16>, rgb <.28, .31, .38> }

plane {
  y, 0
  pigment { checker rgb <.30, .33, .38>, rgb <.24, .27, .32> scale 3 } finish { ambient .14 diffuse .6 reflection .06 }
}

// The rotor leans on a block at the back, the shaft lies before it, and the hand crank stands on its hub.
object { Allblade rotate -58 * x rotate 14 * y translate <-2.9, 4.08, 5.6> }
box { <-5.6, 0, 6.32>, <.2, 3.5, 8.2> pigment { rgb <.42, .30, .20> } finish { ambient .14 diffuse .65 } }
object { Crank translate -Crank_Length / 2 * y rotate 20 * y rotate -90 * z rotate -20 * y translate <-.6, 1.77, -2.6> }
object { Crank1a rotate 172 * y translate <8.9, 1.05, 5.2> }
