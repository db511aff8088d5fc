#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
smooth_triangle { <-1, -1, 0>, <-1, 0, -1>, <1, -1, 0>, <1, 1, -2>, <0, 1, 0>, <0, 1, -1> pigment { rgb 1 } }
triangle { <1, -1, 0>, <1.8, .5, .4>, <.3, 1, .2> pigment { rgb y } no_shadow }
triangle { <-1.6, -.8, .5>, <-.6, .6, .9>, <-1.8, .9, -.3> texture { pigment { rgb x } } interior_texture { pigment { rgb z } } rotate 30*y }
