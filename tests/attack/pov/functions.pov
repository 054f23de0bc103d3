#version 3.7;
#declare f = function { x*y + z }
#debug concat(str(f(2,3,4),0,6), "\n")
#declare k = 3; #declare g = function(a,b) { k*a + f(a,b,1) } #declare k = 0;
#debug concat(str(g(1,2),0,6), "\n")
#declare h = function(a) { select(a,1,2,3) + max(a,1,2) + sum(i,1,3,i*a) + prod(i,1,3,a) }
#debug concat(str(h(2),0,6), " ", str(h(-2),0,6), "\n")
#declare c = function(a) { (a > 1) + 2*(a = 1.00000000001) + 4*(1|0&0) + 8*(a&3) }
#debug concat(str(c(1),0,6), " ", str(c(1.00000000001),0,6), "\n")
#declare u1 = function { u + 2*v } #debug concat(str(u1(1,2,3),0,6), "\n")
#declare s = function { spline { linear_spline 0, <0,1> 2, <4,5> } } #debug concat(vstr(2,s(1),",",0,6), "\n")
#declare s2 = function(a) { s(a).x + s(a).y } #debug concat(str(s2(.5),0,6), "\n")
#declare p = function(y, x) { x - y } #debug concat(str(p(1,5),0,6), "\n")
#declare n3 = function { internal(76) } #declare n1 = function { internal(78) }
#debug concat(str(n3(1.1,2.2,3.3),0,15), " ", str(n1(1.1,2.2,3.3,1),0,15), " ", str(n1(1.1,2.2,3.3,3),0,15), " ",
       str(n1(-7.1,-2.2,30.3,2),0,15), "\n")
