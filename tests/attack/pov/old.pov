declare a = 3
#declare T = texture { pigment { color red 1 } } texture { finish { phong a } }
# if (a > 2) #include "missing.inc" #end
#default { texture { pigment { rgb 1 } } }
#version unofficial 3.5;
#fopen F "data.txt" read #read (F, b, c) #while (defined (F)) #read (F, d) #end #fclose F
#declare O = sphere { <0 1 -2>, 1 texture { T } };
#declare N = <0, 0, 0>; #declare H = trace (O, x, y, N); #declare I = inside (O, H) + min_extent (O).x;
#undef N #warning "careful" #error concat ("no ", str (I, 0, 2))
