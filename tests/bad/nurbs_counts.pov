trimmed_nurbs <
  order 4, 3
  knots_u { 0, 0, 0, 0, 1, 1, 1 }
  knots_v { 0, 0, 0, 1, 1, 1 }
  points 4, 3 { 0*<1, 1, 1>, x, 2*x, 3*x, y, y + x, y + 2*x, y + 3*x, 2*y, 2*y + x, 2*y + 2*x }
>
trimmed_nurbs <
  order 2, 2 knots_u { 0, 0, 1, 1 } knots_v { 0, 0, 1, 1 }
  points 2, 2 { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <1, 1, 0>, <2, 2, 2> }
>
trimmed_nurbs { order 4, 2 knots_u { 0, 0, 0, 0, 1, 1, 1 } knots_v { 0, 0, 1, 1, }
  points 3, 2 { <0, 0, 0>, <1, 0, 0>, <2, 0, 0>, <0, 1, 0>, <1, 1, 0>, <2, 1, 0> } }
trimmed_nurbs { order 2, 2 knots_u { 0, 0, 1, 1 } pigment { rgb 1 } }
trimmed_nurbs {
  order 2, 2
  order 2, 2
  knots_u { 0, 0, 1, 1 } knots_v { 0, 0, 1, 1 }
  points 2, 2 { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>, <1, 1> }
}
trimmed_nurbs { degree 0, 32 knots_u { 0, 1 } knots_v { 0, 1 } points 2, 2 { x, y, z, x } }
nurbs { 1, 2, 2, 2, 0, 0, 1, 1, 0, 0, 1, 1, x, y, z, x + y }
nurbs { 2, 2, 2, 1, 0, 0, 1, 1, 0, 0, 1, 1, x, y, z, x + y }
