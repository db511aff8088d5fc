#macro Plate()
  order 2, 2 knots_u { 0, 0, 1, 1 } knots_v { 0, 0, 1, 1 } points 2, 2 { <0, 0, 0>, x, y, <1, 1, 0> }
#end
trimmed_nurbs < Plate()
  trim { <.2, .2>, <.8, .8> }
  trim { }
>
trimmed_nurbs < Plate()
  trim { <.2, .2>, <.2, .8>, <1.5, .8> }
>
trimmed_nurbs < Plate()
  trim { <.1, .1>, <.1, .6>, <.6, .6>, <.6, .1> }
  trim { <.3, .3>, <.3, .9>, <.9, .9>, <.9, .3> }
>
trimmed_nurbs < Plate()
  trim { <.2, .2>, <.8, .8>, <.8, .3>, <.2, .6> }
>
trimmed_nurbs < Plate()
  trim { <.1, .1>, <.1, .4>, <.4, .4>, <.4, .1> }
  trim { <.6, .6>, <.9, .6>, <.9, .9>, <.6, .9> }
>
trimmed_nurbs < Plate()
  trim {
    curve { order 2 knots { 0, 0, 1, 1 } points 2 { <.2, .2>, <.2, .8> } }
    curve { order 2 knots { 0, 0, 1, 1 } points 2 { <.4, .8>, <.2, .2> } }
  }
>
trimmed_nurbs < Plate()
  trim { curve { order 2 knots { 0, 0, 1, 1 } points 2 { <.2, .2>, <.2, .8> } } }
>
trimmed_nurbs < Plate()
  trim {
    curve { order 3 knots { 0, 0, 1, 1 } points 3 { <.2, .2>, <.2, .8, -1>, <.4, .4, 1, 1> } }
    curve { order 2 knots { 0, 0, 0, 1 } points 2 { <.4, .4>, <.2, .2> } }
  }
>
trimmed_nurbs < Plate()
  trim { curve { order 2 knots { 0, 0, 0, 1 } points 2 { <.4, .4>, <.2, .2> } } }
>
trimmed_nurbs < Plate()
  trim { curve { order 2 } }
  trim { <.2, .2, 1>, <.2, .8>, <.4, .4> }
  keep up
>
trimmed_nurbs < Plate() method newton >
