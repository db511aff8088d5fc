// Every object, with everything that its block may hold.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -10> look_at 0 }
light_source { <10, 20, -30>, 1 }
sphere { 0, 1 }
sphere { <1, 2> .5 }
plane { y, -1 }
box { <-1, -1, -1>, 1 }
cylinder { 0, x, .25 }
cylinder { 0, x, .25 open }
cone { 0, 1, y, 0 }
cone { 0, 1, y, .5 open pigment { rgb 1 } }
torus { 2, .5 }
disc { 0, y, 1 }
disc { 0, y, 1, .5 }
triangle { 0, x, y }
smooth_triangle { 0, -z, x, -z, y, -z }
union { sphere { 0, 1 } box { -1, 1 } }
union {
  sphere { 0, 1 pigment { rgb 1 } }
  union { sphere { x, 1 } sphere { y, 1 } translate z }
  object { sphere { 0, 1 } scale 2 }
  texture { pigment { rgb x } }
}
#declare Ball = sphere { 0, 1 pigment { rgb 1 } }
#declare Same = Ball
#declare Group = union { object { Ball } object { Same translate x } }
object { Ball }
object { Ball scale 2 texture { pigment { rgb y } } }
object { Group rotate 30*y }
#macro At(P) object { Ball translate P } #end
At(<1, 2, 3>)
union { At(x) At(y) }
default { finish { ambient 1 } }
