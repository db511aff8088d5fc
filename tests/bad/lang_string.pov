// A string without its end.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, -x }
#debug "never closed
sphere { 0, 1 }
