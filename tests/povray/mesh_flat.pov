#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
#declare Red = texture { pigment { rgb x } }
#declare Green = texture { pigment { rgb y } }
mesh {
  triangle { <-1, -1, -1>, <1, -1, -1>, <0, 1, 0> }
  triangle { <1, -1, -1>, <0, -1, 1>, <0, 1, 0> texture { Red } }
  triangle { <0, -1, 1>, <-1, -1, -1>, <0, 1, 0> texture { Green } }
  pigment { checker rgb 1 rgb z scale .3 }
  rotate 20*y
}
plane { y, -1.01 pigment { rgb 1 } }
