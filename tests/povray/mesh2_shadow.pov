#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 2, -5> look_at 0 right x*4/3 up y angle 40 }
light_source { <3, 4, -5>, 1 }
background { rgb <.2, .4, .6> }
#declare N = 12;
mesh2 {
  vertex_vectors { N*N, #for (J, 0, N-1) #for (I, 0, N-1) <I/(N-1)*3-1.5, .25*sin(I*1.1)*cos(J*.9), J/(N-1)*3-1.5>, #end #end }
  face_indices { (N-1)*(N-1)*2, #for (J, 0, N-2) #for (I, 0, N-2)
    <J*N+I, J*N+I+1, J*N+N+I>, <J*N+I+1, J*N+N+I+1, J*N+N+I>, #end #end }
  pigment { rgb <.5, .9, .5> }
}
sphere { .8*y, .4 pigment { rgbf <1, .4, .4, .7> } }
