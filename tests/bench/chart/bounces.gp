# Correct bits of a ray's position, bounce by bounce. Set by the caller: data, picture.
set terminal svg size 760,460 font "sans,13" background "white"
set output picture
set title "Two mirror balls, centres 3 radii apart: bits that survive rounding"
set xlabel "bounce"
set ylabel "correct bits"
set yrange [0:66]
set grid lc "grey85"
plot data using 1:2 with points pt 7 lc rgb "#d62728" title "float", "" using 1:3 with lines lc rgb "#d62728" title "theory: 24 - n log_2 3.73", \
    "" using 1:4 with points pt 7 lc rgb "#1f77b4" title "double", "" using 1:5 with lines lc rgb "#1f77b4" title "53 - n log_2 3.73", \
    "" using 1:6 with points pt 7 lc rgb "#111111" title "long double", "" using 1:7 with lines lc rgb "#111111" title "64 - n log_2 3.73"
