#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
intersection {
  box { <-1.2, -1, -1>, <1.2, 1, 1> }
  union { sphere { <-.4, .2, -1>, .7 } sphere { <.4, .2, -1>, .7 } pigment { rgb <1, 1, .5> } inverse }
  pigment { rgb x }
}
