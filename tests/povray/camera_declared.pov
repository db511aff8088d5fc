// A declared camera takes transformations; the last camera counts.
#include "world.inc"
#declare View = camera { location <0, 1.5, -5> look_at <0, .5, 0> angle 45 }
camera { location 9 }
camera { View rotate 35*y }
