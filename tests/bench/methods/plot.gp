# Chart of the methods' time per ray against error, spheres and starts: gnuplot -c plot.gp DATA >chart.svg
set terminal svg size 1000,480 font "sans,12" background "white"
set datafile separator "\t"
set logscale xy
set grid
set nokey
file = ARG1
pick(g, p, v) = (strcol(1) eq g && strcol(3) eq p) ? v : NaN
set multiplot layout 1,2 title "Methods: cheapest lanes of each precision, worst of six kinds of input (filled: float, open: double)"
set xlabel "ns per ray"
set xrange [.5:30]
set title "spheres: error of t (99.9 % are below)"
set format y "10^{%T}"
set yrange [1e-11:1]
plot for [i=1:2] file using (pick("sphere", word("float double", i), $4)):5:(strcol(2)) with labels left \
     point pt (i == 1 ? 7 : 6) offset .6,0 font ",9"
set title "starts on a sphere: share of wrong answers (0 drawn as 10^{-5})"
set yrange [5e-6:2]
plot for [i=1:2] file using (pick("start", word("float double", i), $4)):($6 > 0 ? $6 : 1e-5):(strcol(2)) with labels left \
     point pt (i == 1 ? 7 : 6) offset .6,0 font ",9"
unset multiplot
