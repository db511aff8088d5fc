// Bytes that no scene has.
#version 3.7;
global_settings { assumed_gamma 1 }
sphere { 0, @ }
sphere { é, 1 }
sphere { 0, 1 $ }
sphere { 0, 1 }
