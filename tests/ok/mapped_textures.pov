// Textures that choose between textures, materials and pictures, in every place where they may stand.
#declare Map = texture_map { [0 pigment { rgb 1 }] [1 checker texture { pigment { rgb 0 } } texture { finish { phong 1 } } scale .5] }
#declare Chosen = texture { gradient <1, 2, 0> texture_map { Map } frequency 2 sine_wave rotate 20*y }
#declare Glass = material { texture { Chosen } interior { ior 1.5 } scale 2 }
#declare Clear = material { Glass interior_texture { pigment { rgbt 1 } } interior { ior 1.2 } }
sphere { 0, 1 texture { Chosen scale 2 } translate x }
sphere { 0, 1 material { Glass } material { interior { ior 2 } } }
box { -1, 1 texture { brick texture { Chosen } texture { Chosen } brick_size <1, .4, .5> mortar .1 } }
box { 2, 3 material { Clear } }
