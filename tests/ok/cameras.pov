// Cameras as values; one in the picture.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, 1 }
#declare A = camera { location <0, 1, -5> look_at 0 angle 40 right x*4/3 up y sky y }
#declare B = camera { perspective direction 2*z rotate 90*y translate x }
#declare C = camera { orthographic location -5*z look_at 0 angle 30 }
#declare D = camera { orthographic location -5*z right 4*x up 3*y direction z }
#declare E = camera { A rotate 10*y }
camera { E translate y }
