// The language of POV-Ray's scenes: what #debug prints. The expected lines are what POV-Ray 3.7.0.10 prints for the
// same text (after "#version 3.7;" and before a sphere).
#include "tests/unit/pov/language.h"

using namespace strahl::pov;

TEST_CASE("POV-Ray's values and promotion") {
    check_prints(R"(
#debug concat(vstr(3, <1,2> + <1,2,3>, ",", 0, 3), "\n")
#debug concat(vstr(3, 3 + <1,2>, ",", 0, 3), "\n")
#debug concat(vstr(3, <1,2> + 2*<1,2,3>, ",", 0, 3), "\n")
#debug concat(vstr(3, <1,2> + (2*<1,2,3>), ",", 0, 3), "\n")
#debug concat(vstr(2, <1 -1 2>, ",", 0, 3), "\n")
#debug concat(vstr(5, <1,2,3> + t + u, ",", 0, 3), "\n")
#debug concat(str((7).x, 0, 1), " ", str((2+1).red, 0, 1), " ", str((u+v).gray, 0, 3), "\n")
#debug concat(str((<1,2,3>*2).z, 0, 3), " ", str(<1,2,3,4,5>.transmit, 0, 3), " ", str(<1,.5,.25>.gray, 0,
       6), "\n")
#debug concat(str(2/4*2-1+-3, 0, 3), " ", str(--2, 0, 3), " ", str(!3 + !0, 0, 3), " ", str(1e+3*.5-5., 0,
       3), "\n")
)",
                 R"(
2.000,4.000,3.000
4.000,5.000,0.000
3.000,6.000,0.000
3.000,6.000,6.000
0.000,2.000
2.000,2.000,3.000,1.000,0.000
7.0 3.0 0.886
6.000 5.000 0.620000
-3.000 2.000 1.000 495.000
)");
}

TEST_CASE("POV-Ray's comparisons and logic") {
    check_prints(R"(
#debug concat(str((3>2>1), 0, 0), str((1|0&0), 0, 0), str((0&1|1), 0, 0), str((1=1.00000000001), 0, 0),
       str((1<1.00000000001), 0, 0), "\n")
#debug concat(str((1<=1.0000000001), 0, 0), str((1>=1.00000000009), 0, 0), str((1!=1.000000001), 0, 0),
       str((1e-11?2:3), 0, 0), "\n")
#debug concat(vstr(3, (<1,2,3> < <3,2,1>), ",", 0, 0), " ", vstr(3, (1?<1,2,3>:5), ",", 0, 0), "\n")
#debug concat(str(("abc" < "abd"), 0, 0), str(("abc" = "abc"), 0, 0), str(("b" > "abc"), 0, 0), "\n")
#declare b = (1<2) + !0; #debug concat(str(b, 0, 0), "\n")
)",
                 R"(
00111
1113
1,0,0 1,2,3
111
2
)");
}

TEST_CASE("POV-Ray's built-in functions") {
    check_prints(R"(
#debug concat(str(int(-2.7), 0, 0), " ", str(div(-7,2), 0, 0), " ", str(mod(-7,3), 0, 0), " ",
       str(floor(-2.5), 0, 0), " ", str(ceil(2.1), 0, 0), "\n")
#debug concat(str(select(-1,1,2), 0, 0), str(select(0,1,2), 0, 0), str(select(1,1,2), 0, 0),
       str(select(0,1,2,3), 0, 0), str(select(1,1,2,3), 0, 0), "\n")
#debug concat(str(min(3,1,2), 0, 0), str(max(3,1,2), 0, 0), " ", str(bitwise_xor(6,3), 0, 0),
       str(bitwise_and(6,3), 0, 0), str(bitwise_or(6,3), 0, 0), " ", str(atan2(1,-2), 0, 12), " ",
       str(pow(2,.5), 0, 12), "\n")
#debug concat(str(degrees(1), 0, 12), " ", str(radians(90), 0, 12), " ", str(log(1000), 0, 6), " ",
       str(ln(2), 0, 12), " ", str(tanh(.5), 0, 12), " ", str(asinh(2), 0, 12), "\n")
#debug concat(vstr(3, vaxis_rotate(x,z,90), ",", 0, 6), " ", vstr(3, vrotate(<1,2,3>,<10,20,30>), ",", 0,
       12), " ", vstr(3, vcross(x,y), ",", 0, 0), "\n")
#debug concat(str(vdot(<1,2,3>,<4,5,6>), 0, 0), " ", str(vlength(<2,3,6>), 0, 0), " ", vstr(3,
       vnormalize(<0,3,4>), ",", 0, 3), "\n")
#declare S = seed(42); #declare Q = seed(0);
#debug concat(str(rand(S), 0, 17), " ", str(rand(S), 0, 17), " ", str(rand(Q), 0, 17), " ", str(S, 0, 0),
       str(Q, 0, 0), "\n")
#debug concat(vstr(3, vturbulence(2,.5,6,<1.1,2.2,3.3>), ",", 0, 15), "\n")
#debug concat(vstr(3, vturbulence(1.7,.6,99,<-4.1,.2,-7.3>), ",", 0, 15), "\n")
#debug concat(str(version, 0, 2), " ", str(pi, 0, 15), " ", str(clock, 0, 1), str(true+yes+on, 0, 0),
       str(off, 0, 0), "\n")
)",
                 R"(
-2 -3 -1 -3 3
12223
13 527 2.677945044589 1.414213562373
57.295779513082 1.570796326795 3.000000 0.693147180560 0.462117157260
 1.443635475179
0.000000,1.000000,0.000000 1.067425379399,2.289059482621,2.760581414202 0,0,1
32 7 0.000,0.600,0.800
0.72358291124077112 0.32997925959759838 0.00000287429429658 01
-0.492049152429950,-0.251253908050400,0.422430532175249
-0.240645244168509,0.074517109292024,-0.564464456750006
3.70 3.141592653589793 0.030
)");
}

TEST_CASE("POV-Ray's strings") {
    check_prints(R"(
#debug concat(str(2.5,0,0), "|", str(3.14159,8,3), "|", str(3.14159,-8,3), "|", str(-1,-6,1), "|",
       str(2,0,-1), "\n")
#debug concat(strupr("abC1"), strlwr("ABc"), substr("hello",2,3), substr("abc",0,2),
chr(65), " ", str(asc("a"),0,0), " ",
       str(strlen("four"),0,0), " ", str(val("12.5e1x"),0,1), " ", str(strcmp("ad","ab"),0,0), "\n")
#debug concat("a\"b", "\u0041", "\n")
)",
                 R"(
2|   3.142|0003.142|-001.0|2.000000
ABC1abcellA 97 4 125.0 2
a"bA
)");
}

TEST_CASE("POV-Ray's colours") {
    check_prints(R"(
#macro Show(c) #debug concat(vstr(5, c, ",", 0, 3), "\n") #end
#declare C = rgb .5; Show(C)
#declare C = rgbf .5; Show(C)
#declare C = rgbt .5; Show(C)
#declare C = rgbft .5; Show(C)
#declare C = color .5; Show(C)
#declare C = rgb <1,.5>; Show(C)
#declare C = rgbf <1,1,1>; Show(C)
#declare C = color <1,.5,.25>; Show(C)
#declare Red = rgbt <1,0,0,.25>; Show(Red)
#declare C = color Red filter .3; Show(C)
#declare C = color Red*.5; Show(C)
#declare C = Red*.5 + <0,0,1,0,0>; Show(C)
#declare C = green .25 filter .3; Show(C)
#declare C = color red 1 green .5 transmit .1; Show(C)
Show(rgb <.1,.2,.3>)
#declare C = <1,2,3,4,5>; #debug concat(str(C.red + C.transmit,0,0),"\n")
)",
                 R"(
0.500,0.500,0.500,0.000,0.000
0.500,0.500,0.500,0.500,0.000
0.500,0.500,0.500,0.000,0.500
0.500,0.500,0.500,0.500,0.500
0.500,0.500,0.500,0.500,0.500
1.000,0.500,0.000,0.000,0.000
1.000,1.000,1.000,0.000,0.000
1.000,0.500,0.250,0.000,0.000
1.000,0.000,0.000,0.000,0.250
1.000,0.000,0.000,0.300,0.250
0.500,0.000,0.000,0.000,0.125
0.500,0.000,1.000,0.000,0.125
0.000,0.250,0.000,0.300,0.000
1.000,0.500,0.000,0.000,0.100
0.100,0.200,0.300,0.000,0.000
6
)");
}

TEST_CASE("POV-Ray's scope") {
    check_prints(R"(
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
)",
                 R"(
2 10
6 6
3
gone
1,2
43
)");
}

TEST_CASE("POV-Ray's macros") {
    check_prints(R"(
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
)",
                 R"(
5 9
720
12 19
10
7
8
)");
}

TEST_CASE("POV-Ray's control") {
    check_prints(R"(
#declare i = 0; #declare n = 0; #while (i<1) #declare i = i+.1; #declare n = n+1; #end #debug
       concat(str(n,0,0), "\n")
#for (k,1,2,.25) #debug concat(str(k,0,2)," ") #end #debug concat(str(k,0,2), "\n")
#for (k,3,1,-1) #debug concat(str(k,0,0)," ") #end #debug concat(str(k,0,0), "\n")
#for (k,3,1) #debug "never" #end #debug concat(str(k,0,0), "\n")
#for (k,1,9) #if (k=2) #break #end #debug "x" #end #debug concat(str(k,0,0), "\n")
#macro Sw(w) #switch (w) #case (1) #debug "1" #case (2) #debug "2" #break #range (3,4) #debug "r" #else
       #debug "e" #end #debug " " #end
Sw(1) Sw(2) Sw(2.00000000001) Sw(3.5) Sw(4) Sw(9) #debug "\n"
#switch (0) #case (1 != 1) #debug "a" #case (2 != 1) #debug "b" #range (1+1, 2) #debug "c" #end #debug "\n"
#if (0) #if (1) #debug "no" #else #debug "no" #end #elseif (1) #debug "yes" #elseif (1) #debug "no" #else
       #debug "no" #end #debug "\n"
#if (0) #macro Q() #if (1) #end #end #else #debug "skipped\n" #end
/* nested /* comment */ "still" */ // #debug "no"
# declare z1 = 2; #debug concat(str(z1,0,0), "\n")
)",
                 R"(
11
1.00 1.25 1.50 1.75 2.00 2.25
3 2 1 0
3
x2
12 2 2 re re e
abc
yes
skipped
2
)");
}

TEST_CASE("POV-Ray's '#' before what is no directive is read over") {
    check_prints("#sphere { 0, 1 } # sphere { ##0, #1 } #debug \"end\"", "end");
    check_prints("#macro M() #debug \"in\" #end #if (1) #M() #else #cone { 0 } #end", "in");
    check_fails("#sphere_of { 0 }", "unknown name 'sphere_of'");
}

TEST_CASE("POV-Ray's arrays") {
    check_prints(R"(
#declare A = array[2][3] {{1,2,3},{4,5,6}}
#debug concat(str(A[1][0],0,0), str(A[.99999999999][2],0,0), str(A[.9][1],0,0), str(dimensions(A),0,0),
       str(dimension_size(A,2),0,0), "\n")
#declare B = A; #declare B[0][0] = 9; #debug concat(str(A[0][0],0,0), str(B[0][0],0,0), "\n")
#declare C = array[2]; #declare C[0] = array[2] {7,8} #debug concat(str(C[0][1],0,0), str(defined(C[1]),0,0),
       str(defined(C[0]),0,0), "\n")
#declare D = array[3] {<1,2,3>, x, y+z} #debug concat(vstr(3,D[2]*D[0],",",0,0), "\n")
#declare E = array[2] {"one" "two"} #debug concat(E[1], "\n")
#undef D[1] #ifdef (D[1]) #debug "there" #else #debug "empty" #end #debug "\n"
)",
                 R"(
46223
19
801
0,2,3
two
empty
)");
}

TEST_CASE("POV-Ray's splines") {
    check_prints(R"(
#declare L = spline { 0, <0,0,0> 1, <1,2,3> 3, <0,4,0> }
#debug concat(vstr(3,L(.5),",",0,6), " ", vstr(3,L(2),",",0,6), " ", vstr(3,L(9),",",0,6), "\n")
#declare Q = spline { quadratic_spline 0, <0,0,0> 1, <1,2,3> 3, <0,4,0> }
#debug concat(vstr(3,Q(.5),",",0,6), " ", vstr(3,Q(2),",",0,6), "\n")
#declare N = spline { natural_spline 3, <0,4,0> 0, <0,0,0> 1, <1,2,3> }
#debug concat(vstr(3,N(.5),",",0,6), " ", vstr(3,N(2),",",0,6), "\n")
#declare C = spline { cubic_spline -1, <5,0,0> 0, <0,0,0> 1, <1,2,3> 3, <0,4,0> }
#debug concat(vstr(3,C(.5),",",0,6), " ", vstr(3,C(-.5),",",0,6), " ", vstr(3,C(2),",",0,6), " ",
       vstr(3,C(.5,linear_spline),",",0,6), "\n")
#declare D = spline { natural_spline 0,<0,0,0> 1,<1,2,3> 1,<0,1,5> 3,<3,3,3> 4,<2,2,0> }
#declare E = spline { natural_spline 0,<0,0,0> 1,<1,2,3> 3,<3,3,3> 4,<2,2,0> 1,<0,1,5> }
#debug concat(vstr(3,D(1.5),",",0,6), " ", vstr(3,E(1.5),",",0,6), "\n")
)",
                 R"(
0.500000,1.000000,1.500000 0.500000,3.000000,1.500000 0.000000,4.000000,0.000000
0.625000,1.083333,1.875000 1.000000,3.333333,3.000000
0.593750,1.062500,1.781250 0.875000,3.250000,2.625000
0.218750,0.937500,1.593750 0.000000,0.000000,0.000000 1.000000,2.000000,3.000000
 0.500000,1.000000,1.500000
1.687500,2.671875,3.843750 0.703125,1.687500,5.812500
)");
}

TEST_CASE("POV-Ray's functions") {
    check_prints(R"(
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
#debug concat(str(n3(1.1,2.2,3.3),0,15), " ", str(n1(1.1,2.2,3.3,1),0,15), " ", str(n1(1.1,2.2,3.3,3),0,15),
       " ", str(n1(-7.1,-2.2,30.3,2),0,15), "\n")
)",
                 R"(
10.000000
6.000000
25.000000 -17.000000
12.000000 15.000000
5.000000
2.000000,3.000000
3.000000
4.000000
0.325822997037171 0.112720606142377 0.314429878381400 0.701976105657661
)");
}
