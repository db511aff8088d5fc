// Directives: unknown, without their end or their beginning, of the wrong form.
#version 3.7;
global_settings { assumed_gamma 1 }
#declar A = 1;
#declare sphere = 1;
#declare 5 = 1;
#if 1 #end
#for (I, 1, 10, 0) #end
#for (I 1, 10) #end
#else
#end
#case (1)
#break
#include "no_such_file"
#include 5
#fopen File "file.txt" read
#undef 7
#version 3.8;
#while (1 < 2
#end
#if (1)
sphere { 0, 1 }
