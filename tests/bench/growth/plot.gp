# Seconds against the number of triangles: ready to trace, and tracing. Set by the caller: data, picture.
set terminal svg size 820,380 font "sans,12" background "white"
set output picture
set multiplot layout 1,2 title "A ball of n triangles, 1024x768, two threads"
set logscale xy
set grid lc "grey85"
set xlabel "triangles"
set ylabel "seconds"
set format xy "10^{%L}"
set datafile separator "\t"
set key top left samplen 1 spacing .9 font ",10"
programs = "'Strahl, float' 'Strahl, double' Embree POV-Ray Tachyon"
colors = "#d62728 #ff9896 #9467bd #1f77b4 #2ca02c"
rows(program) = sprintf("< awk -F'\t' '$2 == \"%s\" { print $1 \"\t\" $3 + $4 \"\t\" $5 }' %s", program, data)
set title "reading and building (Embree: building)"
plot for [i=1:5] rows(word(programs, i)) using 1:2 with linespoints pt 7 ps .6 lc rgb word(colors, i) title word(programs, i)
set title "tracing"
plot for [i=1:5] rows(word(programs, i)) using 1:3 with linespoints pt 7 ps .6 lc rgb word(colors, i) title word(programs, i)
