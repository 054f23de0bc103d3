# Hours against processors. Set by the caller: data, picture.
set terminal svg size 820,380 font "sans,12" background "white"
set output picture
set multiplot layout 1,2
set logscale xy
set grid lc "grey85"
set xlabel "processors"
set xrange [2:10000]
set format x "10^{%L}"
set datafile separator "\t"
set key top right samplen 1 spacing .9 font ",10"
set ylabel "hours until it is done"
plot data using 1:2 with lines lw 2 lc rgb "#d62728" title "film of 100,000 frames", \
     data using 1:($4+$5) with lines lw 2 lc rgb "#1f77b4" title "still of 100 gigapixels", \
     data using 1:5 with lines lw 1 dt 2 lc rgb "#1f77b4" title "... of which joining"
set ylabel "processor hours"
set key top left
plot data using 1:3 with lines lw 2 lc rgb "#d62728" title "film", \
     data using 1:6 with lines lw 2 lc rgb "#1f77b4" title "still"
