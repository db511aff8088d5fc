#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
#declare M = mesh {
  triangle { <-1, -1, -1>, <1, -1, -1>, <0, 1, 0> }
  triangle { <1, -1, -1>, <0, -1, 1>, <0, 1, 0> }
  triangle { <0, -1, 1>, <-1, -1, -1>, <0, 1, 0> }
  triangle { <-1, -1, -1>, <1, -1, -1>, <0, -1, 1> }
  inside_vector <.1, 1, .2>
}
difference { object { M } sphere { <.2, 0, -.6>, .5 pigment { rgb y } } pigment { rgb x } translate -.7*x }
intersection { object { M } box { <-2, -.6, -.7>, <2, .3, .3> pigment { rgb z } } pigment { rgb <1, 1, 0> } translate .9*x }
