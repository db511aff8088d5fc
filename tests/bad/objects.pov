sphre { 0, 1 }
sphere { 0, 1
camera { location 0 }
sphere { 0, 1 }
cylinder { 0, 0, 1 }
plane { 0, 1 }
triangle { 0, 0, 0 }
sphere { 0, 1 pigment { rgb 1 } uv_mapping }
sphere { 0, 1 scale <1, 0, 1> }
sphere { 0, 1 matrix <0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0> }
object { }
object { Nothing }
sphere { 0, 1 radius 2 }
bicubic_patch { u_steps 1 x, y, z, x, y, z, x, y, z, x, y, z, x, y, z, x }
sphere { 0, 1 };
box { 0, 1 photons { target } photons { target } bounded_by { sphere { 0, 2 } } }
light_source { 0, 1 area_light x, z, 0, 2 jitter }
blob { threshold .5 }
union { light_source { 0, 1 radios 3 } }
#declare Lamp = light_source { 0, 1 looks_like { sphere { 0, 1 } } }
light_source { Lamp }
