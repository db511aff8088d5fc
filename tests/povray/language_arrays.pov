// Arrays: of numbers, of vectors, of objects, of two dimensions, given to macros.
#include "stage.inc"
#declare P = array[4] { <-1.5, 0, 0>, <-.5, .4, 0>, <.5, .2, .3>, <1.5, .8, .1> }
#declare C = array[2][2] { { rgb x, rgb y }, { rgb z, rgb <1, 1, 0> } }
#declare O = array[3];
#declare O[0] = sphere { 0, .4 }
#declare O[1] = box { -.3, .3 }
#declare O[2] = cone { -.3*y, .4, .5*y, 0 }
#macro Put(A, I) object { A[mod(I, 3)] translate P[I] pigment { C[mod(I, 2)][div(I, 2)] } } #end
#for (I, 0, dimension_size(P, 1) - 1) Put(O, I) #end
