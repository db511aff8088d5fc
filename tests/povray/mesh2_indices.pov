#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
mesh2 {
  vertex_vectors { 5, <-1, -1, 0>, <1, -1, 0>, <1, 1, 0>, <-1, 1, 0>, <0, 0, -.8> }
  normal_vectors { 3, <-1, 0, -1>, <1, 0, -1>, <0, 0, -1> }
  uv_vectors { 4, <0, 0>, <1, 0>, <1, 1>, <0, 1> }
  face_indices { 4, <0, 1, 4>, <1, 2, 4>, <2, 3, 4>, <3, 0, 4> }
  uv_indices { 4, <0, 1, 2>, <1, 2, 3>, <0, 1, 3>, <3, 0, 2> }
  normal_indices { 2, <0, 1, 2>, <1, 1, 2> }
  texture { uv_mapping pigment { checker rgb <1, .5, 0> rgb 1 scale .2 } }
}
