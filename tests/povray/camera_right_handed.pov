// z up, right-handed by a negative right vector.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <3, -6, 2> sky z up z right <-4/3, 0, 0> direction y look_at <0, 0, .5> angle 35 }
light_source { <-3, -6, 8> rgb 1 }
plane { z, 0 pigment { checker rgb .8, rgb .4 } }
box { <-1, -.5, 0>, <.4, .5, .8> pigment { rgb <.9, .3, .2> } }
cylinder { <1, 1, 0>, <1, 1, 1.5>, .4 pigment { rgb <.2, .8, .3> } }
