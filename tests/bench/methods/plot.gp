# Chart of the methods' time per ray against error, spheres and starts: gnuplot -c plot.gp DATA >chart.svg
set terminal svg size 1000,520 font "sans,12" background "white"
set datafile separator "\t"
set logscale xy
set grid
set nokey
file = ARG1
pick(g, p, v) = (strcol(1) eq g && strcol(3) eq p) ? v : NaN
set multiplot layout 1,2 title "Methods: the cheapest lanes of float (filled) and double (open)"
set xlabel "ns per ray"
set xrange [.5:30]
set lmargin 9
set title "spheres: far balls: points off the surface, in radii"
set format y "10^{%T}"
set yrange [1e-17:1e5]
plot for [i=1:2] file using (pick("sphere", word("float double", i), $4)):5:(strcol(2)) with labels left \
     point pt (i == 1 ? 7 : 6) offset .6,0 rotate by (i == 1 ? 28 : -28) font ",9"
set title "starts in float: wrong at the worst size"
unset logscale
set format y "%g %%"
set xrange [0:12]
set yrange [-5:110]
plot file using (pick("start", "float", $4)):(100 * $6):(strcol(2)) with labels left point pt 7 offset .6,0 font ",9"
unset multiplot
