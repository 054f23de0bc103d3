#version 3.7;
#macro B(a) a+1 #end
#debug concat(str(B(2)*3, 0, 0), " ", str((B(2))*3, 0, 0), "\n")
#macro F(n) (n<2 ? 1 : n) #end
#macro Fact(n) #if (n<2) #local r = 1; #else #local r = n*Fact(n-1); #end r #end
#debug concat(str(Fact(6), 0, 0), "\n")
#macro Half(p) sphere { p, #end
Half(<1,2,3>) 1 }
#macro Two(a b) a*10+b #end
#debug concat(str(Two(1 2), 0, 0), " ", str(Two((1+1), -1), 0, 0), "\n")
#macro Sum(a, n) #local s = 0; #local i = 0; #while (i<n) #local s = s + a[i]; #local i = i+1; #end s #end
#declare A = array[4] {1,2,3,4}
#debug concat(str(Sum(A,4), 0, 0), "\n")
#macro Set(a) #declare a[0] = 7; #end Set(A) #debug concat(str(A[0], 0, 0), "\n")
#macro First(n) #local k = 0; #while (1) #if (k*k>n) #break #end #local k = k+1; #end k #end
#debug concat(str(First(50), 0, 0), "\n")
