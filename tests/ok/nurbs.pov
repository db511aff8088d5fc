// Trimmed NURBS surfaces in every form.
#version 3.7;
global_settings { assumed_gamma 1 }
light_source { <10, 20, -30>, 1 }
trimmed_nurbs <
  order 2, 2
  knots_u { 0, 0, 1, 1 }
  knots_v { 0, 0, 1, 1 }
  points 2, 2 { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <1, 1, 0> }
>
trimmed_nurbs {
  points 3, 2 { <0, 0, 0> <1, 0, 0, .5> <2, 0, 0> <0, 1, 0, 1> <1, 1, 0, .5> <2, 1, 0, 1> }
  knots_v { 0 0 1 1 }
  knots_u { 0 0 0 1 1 1 }
  degree 2, 1
}
#declare Plate = trimmed_nurbs <
  order 4, 3
  knots_u { 0, 0, 0, 0, 1, 1, 1, 1 }
  knots_v { 0, 0, 0, 1, 1, 1 }
  points 4, 3 {
    #for (J, 0, 2) #for (I, 0, 3) <I, J, I*J/6>, #end #end
  }
  trim { <.25, .25>, <.75, .25>, <.75, .75>, <.25, .75> }
  trim {
    curve { order 3 knots { 0, 0, 0, 1, 1, 1 } points 3 { <.4, .5>, <.4, .6, .7>, <.5, .6> } }
    curve { degree 1 knots { 0, 0, 1, 2, 2 } points 3 { <.5, .6>, <.6, .5>, <.4, .5> } }
  }
  keep left
  flatness .5
  method paper
  flattening adaptive
  max_iterations 7
  pigment { rgb x } rotate <0, 0, 45>
>
object { Plate translate x }
union {
  object { Plate }
  trimmed_nurbs < order 2, 2 knots_u { 0, 0, 1, 1 } knots_v { 0, 0, 1, 1 }
    points 2, 2 { 0*<1, 1, 1>, x, y, <1, 1, 0> } keep right flattening curvature scale 2 >
  texture { pigment { rgb 1 } }
}
nurbs { 2, 3, 2, 4, 0, 0, 1, 1, 0, 0, 0, 1/2, 1, 1, 1,
  <0, 0, 0, 1> <1, 0, 0, 1>
  <0, 1, 0, 1> <1, 1, 0, 1>
  <0, 2, 0, 2> <1, 2, 0, 2>
  <0, 3, 0, 1> <1, 3, 0, 1>
  pigment { rgb 1 }
}
bicubic_patch { type 1 flatness .01 u_steps 3 v_steps 3
  #for (I, 0, 3) #for (J, 0, 3) <I, J, I*J/9> #end #end
  pigment { rgb 1 }
}
bicubic_patch { type 0, u_steps 4, v_steps 4,
  0, x, 2*x, 3*x, y, x+y, 2*x+y, 3*x+y, 2*y, x+2*y, 2*x+2*y, 3*x+2*y, 3*y, x+3*y, 2*x+3*y, 3*x+3*y
}
