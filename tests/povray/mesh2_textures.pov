#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
mesh2 {
  vertex_vectors { 4, <-1, -1, -1>, <1, -1, -1>, <0, -1, 1>, <0, 1, 0> }
  texture_list { 3, texture { pigment { rgb x } } texture { pigment { checker rgb y rgb 1 scale .3 } finish { phong .6 } }
    texture { pigment { rgbt <0, 0, 1, .5> } } }
  face_indices { 4, <0, 1, 3>, 0, <1, 2, 3>, 1, <2, 0, 3>, 2, <0, 1, 2> }
  pigment { rgb <1, 1, 0> }
  scale 1.1 rotate 150*y
}
plane { y, -1.2 pigment { checker rgb 1 rgb .3 } }
