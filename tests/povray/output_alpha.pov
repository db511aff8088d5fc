// povray: +UA
// An alpha channel: nothing, glass, and what is opaque.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 2.5, -6> look_at <0, .6, 0> angle 40 }
light_source { <-5, 8, -6> rgb 1 }
sphere { <-1, .2, 0>, .7 pigment { rgbf <.9, .3, .1, .7> } finish { phong .8 } }
sphere { <.7, .2, 0>, .7 pigment { rgb <.2, .5, .9> } }
disc { <0, 1.6, 0>, z, .5 pigment { rgbt <.9, .9, .2, .4> } }
