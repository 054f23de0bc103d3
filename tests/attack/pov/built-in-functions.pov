#version 3.7;
#debug concat(str(int(-2.7), 0, 0), " ", str(div(-7,2), 0, 0), " ", str(mod(-7,3), 0, 0), " ", str(floor(-2.5),
       0, 0), " ", str(ceil(2.1), 0, 0), "\n")
#debug concat(str(select(-1,1,2), 0, 0), str(select(0,1,2), 0, 0), str(select(1,1,2), 0, 0), str(select(0,1,2,3),
       0, 0), str(select(1,1,2,3), 0, 0), "\n")
#debug concat(str(min(3,1,2), 0, 0), str(max(3,1,2), 0, 0), " ", str(bitwise_xor(6,3), 0, 0),
       str(bitwise_and(6,3), 0, 0), str(bitwise_or(6,3), 0, 0), " ", str(atan2(1,-2), 0, 12), " ", str(pow(2,.5),
       0, 12), "\n")
#debug concat(str(degrees(1), 0, 12), " ", str(radians(90), 0, 12), " ", str(log(1000), 0, 6), " ", str(ln(2), 0,
       12), " ", str(tanh(.5), 0, 12), " ", str(asinh(2), 0, 12), "\n")
#debug concat(vstr(3, vaxis_rotate(x,z,90), ",", 0, 6), " ", vstr(3, vrotate(<1,2,3>,<10,20,30>), ",", 0, 12),
       " ", vstr(3, vcross(x,y), ",", 0, 0), "\n")
#debug concat(str(vdot(<1,2,3>,<4,5,6>), 0, 0), " ", str(vlength(<2,3,6>), 0, 0), " ", vstr(3,
       vnormalize(<0,3,4>), ",", 0, 3), "\n")
#declare S = seed(42); #declare Q = seed(0);
#debug concat(str(rand(S), 0, 17), " ", str(rand(S), 0, 17), " ", str(rand(Q), 0, 17), " ", str(S, 0, 0), str(Q,
       0, 0), "\n")
#debug concat(vstr(3, vturbulence(2,.5,6,<1.1,2.2,3.3>), ",", 0, 15), "\n")
#debug concat(vstr(3, vturbulence(1.7,.6,99,<-4.1,.2,-7.3>), ",", 0, 15), "\n")
#debug concat(str(version, 0, 2), " ", str(pi, 0, 15), " ", str(clock, 0, 1), str(true+yes+on, 0, 0), str(off, 0,
       0), "\n")
