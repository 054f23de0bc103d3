#version 3.7;
#declare i = 0; #declare n = 0; #while (i<1) #declare i = i+.1; #declare n = n+1; #end #debug concat(str(n,0,0),
       "\n")
#for (k,1,2,.25) #debug concat(str(k,0,2)," ") #end #debug concat(str(k,0,2), "\n")
#for (k,3,1,-1) #debug concat(str(k,0,0)," ") #end #debug concat(str(k,0,0), "\n")
#for (k,3,1) #debug "never" #end #debug concat(str(k,0,0), "\n")
#for (k,1,9) #if (k=2) #break #end #debug "x" #end #debug concat(str(k,0,0), "\n")
#macro Sw(w) #switch (w) #case (1) #debug "1" #case (2) #debug "2" #break #range (3,4) #debug "r" #else #debug
       "e" #end #debug " " #end
Sw(1) Sw(2) Sw(2.00000000001) Sw(3.5) Sw(4) Sw(9) #debug "\n"
#if (0) #if (1) #debug "no" #else #debug "no" #end #elseif (1) #debug "yes" #elseif (1) #debug "no" #else #debug
       "no" #end #debug "\n"
#if (0) #macro Q() #if (1) #end #end #else #debug "skipped\n" #end
/* nested /* comment */ "still" */ // #debug "no"
# declare z1 = 2; #debug concat(str(z1,0,0), "\n")
