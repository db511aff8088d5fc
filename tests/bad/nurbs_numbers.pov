#declare Huge = 1e308;
trimmed_nurbs <
  order 3, 2
  knots_u { 0, 0, 0, 2, 1, 3, 3, 3 }
  knots_v { 1, 1, 0, 0 }
  points 5, 2 {
    <0, 0, 0>, <1, 0, 0, 0>, <2, 0, 0, -1>, <3, 0, 0>, <4, 0, 0, Huge*10>,
    <0, 1, 0>, <1, 1, 0>, <Huge*10, 1, 0>, <3, 1, 0>, <4, 1, 0>
  }
>
trimmed_nurbs <
  order 3, 2
  knots_u { 0, 0, 0, .5, .5, .5, .5, 1, 1, 1 }
  knots_v { 0, 0, 1, 1 }
  points 7, 2 { #for (I, 0, 13) <mod(I, 7), int(I/7), 0>, #end }
>
trimmed_nurbs <
  order 3, 2
  knots_u { 0, 0, 0, 1, 1, 1 }
  knots_v { 0, 0, 0, 1 }
  points 3, 2 { <0, 0, 0>, <1, 0, 0>, <2, 0, 0>, <0, 1, 0>, <1, 1, 0>, <2, 1, 0> }
>
trimmed_nurbs < order 2, 2 knots_u { 0, 1, 1, 2 } knots_v { 0, 0, 1, 1 } points 2, 2 { x, y, z, x + y } >
trimmed_nurbs <
  order 2, 2 knots_u { 0, 0, 1, 1 } knots_v { 0, 0, 1, 1 } points 2, 2 { x, y, z, x + y }
  flatness 0
  max_iterations 0
>
