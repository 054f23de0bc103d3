#version 3.7;
#debug concat(vstr(3, <1,2> + <1,2,3>, ",", 0, 3), "\n")
#debug concat(vstr(3, 3 + <1,2>, ",", 0, 3), "\n")
#debug concat(vstr(3, <1,2> + 2*<1,2,3>, ",", 0, 3), "\n")
#debug concat(vstr(3, <1,2> + (2*<1,2,3>), ",", 0, 3), "\n")
#debug concat(vstr(2, <1 -1 2>, ",", 0, 3), "\n")
#debug concat(vstr(5, <1,2,3> + t + u, ",", 0, 3), "\n")
#debug concat(str((<1,2,3>*2).z, 0, 3), " ", str(<1,2,3,4,5>.transmit, 0, 3), " ", str(<1,.5,.25>.gray, 0, 6), "\n")
#debug concat(str(2/4*2-1+-3, 0, 3), " ", str(--2, 0, 3), " ", str(!3 + !0, 0, 3), " ", str(1e+3*.5-5., 0, 3), "\n")
