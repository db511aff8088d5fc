// assumed_gamma srgb.
#version 3.7;
global_settings { assumed_gamma srgb }
camera { location <0, 1, -5> look_at 0 }
light_source { <-5, 8, -6> srgb <1, .9, .8> }
sphere { 0, 1 pigment { srgb <.5, .25, .75> } finish { phong .3 } }
plane { y, -1 pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } scale 2 } finish { ambient .4 } }
