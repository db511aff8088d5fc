#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
mesh {
  triangle { <-1, -1, 0>, <1, -1, 0>, <0, 1, 0> uv_vectors <0, 0>, <1, 0>, <.5, 1> }
  triangle { <1, -1, 0>, <1.6, 1, .5>, <0, 1, 0> uv_vectors <1, 0>, <1, 1>, <.5, 1> }
  texture { uv_mapping pigment { checker rgb x rgb 1 scale .1 } }
}
