// #error ends the reading.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, x }
#warning "mind the gap"
#error concat("stop", " here")
sphere { 0, x }
