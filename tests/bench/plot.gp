# One log-log plot: gnuplot -e "data='plot-x.dat'" -e "picture='x.svg'" plot.gp
set terminal svg size 720,480 font "sans-serif,13" background "#ffffff"
set output picture
set datafile missing "-"
set logscale xy
set format x "%.0s%c"
if (strstrt(data, 'plot-threads')) set logscale x 2
set format y "%g"
set xlabel system("head -n 1 '" . data . "' | cut -d ' ' -f 1 | tr _ ' '")
set ylabel "seconds for hierarchy and tracing"
set grid lw 0.5 lc rgb "#cccccc"
set key outside right top autotitle columnhead
set offsets graph 0.03, graph 0.03, 0, 0
set linetype 5 lc rgb "#882255"
columns = words(system("sed -n 2p '" . data . "'"))
set style data linespoints
if (strstrt(data, 'plot-rays')) set style data points
plot for [i=2:columns] data using 1:i lw 2 pt 7 ps 0.6
