// Layers: the last written is on top; filters between them; finishes of their own.
#include "stage.inc"
sphere { <-1.4, .2, 0>, .7
  texture { pigment { rgb <.9, .3, .2> } finish { phong .5 } }
  texture { pigment { gradient y color_map { [.5 rgbt 1] [.5 rgbt <.1, .2, .7, .2>] } scale .3 } finish { ambient .4 } } }
#declare Two = texture { pigment { rgb <.2, .7, .3> } } texture { pigment { checker rgbf <1, 1, 0, .9>, rgbt <1, 1, 1, 1> scale .2 } }
box { -.5, .5 rotate 20*y texture { Two } }
#declare O = sphere { <1.5, .1, 0>, .6 texture { pigment { rgb <.3, .4, .9> } } }
object { O texture { pigment { onion color_map { [.4 rgbt 1] [.4 rgb 1] } scale .2 } } }
