# Error against time, one panel a world. Set by the caller: data, picture.
set terminal svg size 1000,680 font "sans,12" background "white"
set output picture
set multiplot layout 2,3 title "RMS error of averages over pixels, 640x480, against 1024 rays a pixel"
set logscale xy
set grid lc "grey85"
set xlabel "seconds, two threads"
set ylabel "RMS error in 1/510"
set format x "10^{%L}"
set key top right samplen 1 spacing .9 font ",10"
set yrange [.08:60]
worlds = "article flythrough wires checks_floor thin_things"
series = "cells grid POV-Ray_+AM1 POV-Ray_+AM2 Tachyon"
names = "Strahl Strahl,_grids POV-Ray_+AM1 POV-Ray_+AM2 Tachyon"
colors = "#d62728 #ff9896 #1f77b4 #17becf #2ca02c"
do for [w in worlds] {
    set title system("echo '".w."' | tr _ ' '")
    plot for [i=1:5] sprintf("< awk -F'\t' -v w='%s' -v s='%s' 'BEGIN { gsub(\"_\", \" \", s) } $1 == w && $2 == s { print $4, $5 }' %s", \
        w, word(series, i), data) using 1:2 with linespoints pt 7 ps .6 lc rgb word(colors, i) \
        title system("echo '".word(names, i)."' | tr _ ' '")
}
