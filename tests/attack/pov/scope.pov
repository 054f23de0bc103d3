#version 3.7;
#declare a = 1;
#macro M() #declare a = 2; #local b = 5; #end
#macro N() #local a = 10; M() #debug concat(str(a,0,0), " ") #end
N() #debug concat(str(a,0,0), str(defined(b),0,0), "\n")
#macro P(q) #local q = q + 1; #end
#declare w = 5; P(w) #debug concat(str(w,0,0), " ") P(w+0) #debug concat(str(w,0,0), "\n")
#declare A = array[2] {1,2}; P(A[1]) #debug concat(str(A[1],0,0), "\n")
#ifdef (a) #undef a #end #ifndef (a) #debug "gone\n" #end
#declare a = "text"; #declare a = <1,2>; #debug concat(vstr(2,a,",",0,0), "\n")
#local c = 3; #macro K() #local c = 4; #debug str(c,0,0) #end K() #debug concat(str(c,0,0), "\n")
