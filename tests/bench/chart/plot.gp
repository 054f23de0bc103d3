# Time against error, one panel per scene. Set by the caller: points, picture, col, what, least.
set terminal svg size 1200,780 font "sans,13" background "white"
set output picture
set datafile separator "\t"
set multiplot layout 2,3 title "Speed against accuracy: left and low is better"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "seconds per megapixel"
set ylabel what
set grid lc "grey85"
set key off
worlds = "easy mirrors glass far many"
titles = "'easy: the article with matt bodies' 'deep mirrors: four touching balls' 'glass and mirrors: the article' 'far from the origin' 'many bodies: sphere flake of 7381'"
y(v) = v < least ? least : v
series = "float double extended SIMD --error --depth POV-Ray Tachyon proved"
colours = "#d62728 #1f77b4 #111111 #bbbbbb #2ca02c #ff7f0e #9467bd #8c564b #17becf"
shapes = "7 7 7 6 5 9 11 13 15"
do for [i=1:5] {
    set title word(titles, i)
    set yrange [least / 2:2]
    plot for [j=1:9] points using (strcol(1) eq word(worlds, i) && strcol(2) eq word(series, j) ? $4 : NaN):(y(column(col))) \
        with points pt int(word(shapes, j)) ps (j < 4 ? 1.3 : .8) lc rgb word(colours, j) notitle, \
        points using (strcol(1) eq word(worlds, i) && strcol(2) eq "--error" ? $4 : NaN):(y(column(col))) with lines lc rgb "#2ca02c" notitle
}
set title ""
unset xlabel; unset ylabel; unset tics; unset border; unset logscale; unset grid
set key center center Left reverse samplen 1
set xrange [0:1]; set yrange [0:1]
plot for [j=1:9] -1 with points pt int(word(shapes, j)) ps 1.3 lc rgb word(colours, j) title word(series, j), \
    -1 with lines lc rgb "white" title sprintf("(at the bottom: %g or less)", least)
unset multiplot
