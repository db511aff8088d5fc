// A bent plate with holes, patterned by uv, over a floor; a crease; a ball among primitives.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 3.4, -4.2> look_at <.6, .25, .4> angle 50 right x * image_width / image_height }
light_source { <-4, 7, -6>, rgb .9 }
background { rgb <.3, .4, .5> }
plane { y, -.5 pigment { checker rgb .8, rgb .5 } }
trimmed_nurbs {
  order 4, 3
  knots_u { 0, 0, 0, 0, 1, 1, 1, 1 }
  knots_v { 0, 0, 0, 1, 1, 1 }
  points 4, 3 {
    <-1, 0, -1>, <-.3, .9, -1>, <.4, -.5, -1>, <1, .3, -1>,
    <-1, .4, 0>, <-.3, 1, 0, 2>, <.4, .2, 0>, <1, .6, 0>,
    <-1, 0, 1>, <-.3, .8, 1>, <.4, -.3, 1>, <1, .2, 1>
  }
  trim { curve { order 3 knots { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 }
    points 9 { <.5, .3>, <.5, .5, .7071067811865476>, <.3, .5>, <.1, .5, .7071067811865476>, <.1, .3>,
      <.1, .1, .7071067811865476>, <.3, .1>, <.5, .1, .7071067811865476>, <.5, .3> } } }
  trim { <.6, .6>, <.9, .65>, <.8, .9>, <.55, .8> }
  uv_mapping
  texture { pigment { checker rgb <.9, .5, .1>, rgb <.95, .9, .8> scale .1 } finish { phong .6 phong_size 30 } }
}
trimmed_nurbs {
  order 2, 3
  knots_u { 0, 0, .5, 1, 1 }
  knots_v { 0, 0, 0, 1, 1, 1 }
  points 3, 3 { <0, 0, 0>, <.6, .7, 0>, <1.2, 0, 0>, <0, .3, .8>, <.6, 1, .8>, <1.2, .3, .8>, <0, 0, 1.6>, <.6, .7, 1.6>, <1.2, 0, 1.6> }
  pigment { rgb <.3, .6, .9> } finish { specular .5 }
  translate <1.2, -.45, -.4>
}
sphere { <.2, .9, .5>, .3 pigment { rgb <.8, .1, .1> } finish { reflection .3 } }
