#version 3.7;
#declare L = spline { 0, <0,0,0> 1, <1,2,3> 3, <0,4,0> }
#debug concat(vstr(3,L(.5),",",0,6), " ", vstr(3,L(2),",",0,6), " ", vstr(3,L(9),",",0,6), "\n")
#declare Q = spline { quadratic_spline 0, <0,0,0> 1, <1,2,3> 3, <0,4,0> }
#debug concat(vstr(3,Q(.5),",",0,6), " ", vstr(3,Q(2),",",0,6), "\n")
#declare N = spline { natural_spline 3, <0,4,0> 0, <0,0,0> 1, <1,2,3> }
#debug concat(vstr(3,N(.5),",",0,6), " ", vstr(3,N(2),",",0,6), "\n")
#declare C = spline { cubic_spline -1, <5,0,0> 0, <0,0,0> 1, <1,2,3> 3, <0,4,0> }
#debug concat(vstr(3,C(.5),",",0,6), " ", vstr(3,C(-.5),",",0,6), " ", vstr(3,C(2),",",0,6), " ",
       vstr(3,C(.5,linear_spline),",",0,6), "\n")
