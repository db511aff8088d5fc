/* Mechanical parts, after the paper's Figure 10: crankshaft, hand crank and turbine rotor together.
 * Surfaces: 73 + 20 + 351. Trims: 64 + 18. */
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 4 }
#include "crank.inc"
#include "crank1a.inc"
#include "allblade.inc"

camera { location <-3, 17, -21> look_at <.3, 1.6, .6> angle 36 right x * image_width / image_height }
background { rgb <.16, .18, .22> }
light_source { <-16, 24, -12>, rgb <.95, .93, .88> }
light_source { <16, 12, -14>, rgb <.26, .29, .36> }

plane { y, 0 pigment { checker rgb <.30, .33, .38>, rgb <.25, .28, .33> scale 3 } finish { ambient .14 diffuse .6 reflection .06 } }

// The rotor leans on a block at the back, the shaft lies before it on two V-blocks, the hand crank stands on its hub.
object { Allblade rotate -62 * x rotate 16 * y translate <-3.4, 4.35, 5.2> }
box { <-6.2, 0, 6.9>, <-.6, 2.2, 8.2> pigment { rgb <.42, .30, .20> } finish { ambient .14 diffuse .65 } }
object { Crank translate -Crank_Length / 2 * y rotate 20 * y rotate -90 * z rotate -24 * y translate <.6, 1.77, -1.6> }
object { Crank1a rotate -50 * y translate <5.2, 1.05, 1.2> }
