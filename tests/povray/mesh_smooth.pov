#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
mesh {
  smooth_triangle { <-1, -1, 0>, <-1, 0, -1>, <1, -1, 0>, <1, 1, -2>, <0, 1, 0>, <0, 1, -1> }
  smooth_triangle { <-1, -1, 0>, <-1, 0, -1>, <0, 1, 0>, <0, 1, -1>, <-1.5, 1, .5>, <-2, 1, -1> }
  smooth_triangle { <1, -1, 0>, <.5, .6, -1>, <1.5, 1, .5>, <.5, .6, -1>, <0, 1, 0>, <.5, .6, -1> }
  pigment { rgb <1, .8, .6> } finish { phong .7 }
  rotate <0, 15, 10> scale <1, .8, 1>
}
