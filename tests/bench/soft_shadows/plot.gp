# Error against shadow rays and against time. Set by the caller: data, picture.
set terminal svg size 900,400 font "sans,12" background "white"
set output picture
set multiplot layout 1,2 title "RMS error of soft shadows, 640x480, against 16,384 points of the lamp"
set logscale xy
set grid lc "grey85"
set ylabel "RMS error in 1/510"
set format x "10^{%L}"
set key bottom left samplen 1 spacing .9 font ",10"
series = "Strahl Strahl,_grids POV-Ray,_grids POV-Ray,_17x17_adaptive"
colors = "#d62728 #ff9896 #1f77b4 #17becf"
labels = "shadow_rays_a_pixel seconds,_two_threads"
do for [panel=1:2] {
    set xlabel system("echo '".word(labels, panel)."' | tr _ ' '")
    plot for [i=1:4] sprintf("< awk -F'\t' -v s='%s' 'BEGIN { gsub(\"_\", \" \", s) } $1 == s { print $%d, $5 }' %s", \
        word(series, i), panel + 2, data) using 1:2 with linespoints pt 7 ps .6 lc rgb word(colors, i) \
        title system("echo '".word(series, i)."' | tr _ ' '")
}
