// With `angle`, the width is that of the perspective view at look_at.
#include "world.inc"
camera { orthographic location <2, 3, -5> look_at <0, .5, 0> right 4/3*x angle 45 }
