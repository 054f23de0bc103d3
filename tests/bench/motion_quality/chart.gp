# Error of pictures in motion against the time for each. Set by the caller: data, picture.
# Needs Debian's gnuplot-nox.
set terminal svg noenhanced size 900,640 font "sans,13" background "white"
set output picture
set multiplot layout 2,2 title "Pictures in motion beside finished ones"
set logscale x 2
set xtics (6.7, 13.3, 26.7, 53.3)
set xlabel "processor time for a picture, ms"
set ylabel "RMS, steps of 1/255"
set grid lc "grey85"
set yrange [0:*]
set key bottom left samplen 2 font ",11"
do for [i=0:3] {
    plot data index i using 1:2 with linespoints pt 7 lc rgb "#d62728" title columnheader(1), \
        "" index i using 1:3 with linespoints pt 7 lc rgb "#1f77b4" title "sharpened", \
        "" index i using 1:4 with lines lc rgb "#888888" title "one ray in each pixel"
}
