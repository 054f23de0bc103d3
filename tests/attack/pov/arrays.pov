#version 3.7;
#declare A = array[2][3] {{1,2,3},{4,5,6}}
#debug concat(str(A[1][0],0,0), str(A[.99999999999][2],0,0), str(A[.9][1],0,0), str(dimensions(A),0,0),
       str(dimension_size(A,2),0,0), "\n")
#declare B = A; #declare B[0][0] = 9; #debug concat(str(A[0][0],0,0), str(B[0][0],0,0), "\n")
#declare C = array[2]; #declare C[0] = array[2] {7,8} #debug concat(str(C[0][1],0,0), str(defined(C[1]),0,0),
       str(defined(C[0]),0,0), "\n")
#declare D = array[3] {<1,2,3>, x, y+z} #debug concat(vstr(3,D[2]*D[0],",",0,0), "\n")
#declare E = array[2] {"one" "two"} #debug concat(E[1], "\n")
#undef D[1] #ifdef (D[1]) #debug "there" #else #debug "empty" #end #debug "\n"
