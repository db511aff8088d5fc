// Compounds, clipping and meshes: everything that the rules read.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 }
#declare Part = difference {
  box { -1, 1 }
  sphere { 0, 1.2 inverse }
  cylinder { -2*z, 2*z, .3 open pigment { rgb x } }
  pigment { rgb 1 }
}
object { Part inverse }
intersection {
  object { Part }
  merge { sphere { 0, 1 } torus { 1, .2 } plane { y, 0 } }
  union { disc { 0, y, 1 } triangle { x, y, z } }
  clipped_by { plane { x, 0 } object { Part scale 2 } }
  interior { ior 1.5 }
  no_shadow
}
merge { union { sphere { 0, 1 } box { 0, 1 } } difference { object { Part } sphere { 0, 1 } } }
