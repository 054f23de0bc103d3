# The error of a resting picture in the window over time. Set by the caller: folder, picture.
set terminal svg size 760,500 font "sans,13" background "white"
set output picture
set title "Error after the camera stopped: the window's first picture and its passes, float"
set logscale xy
set xlabel "seconds per megapixel"
set ylabel "error"
set format x "10^{%L}"
set format y "10^{%L}"
set grid lc "grey85"
set key below maxrows 2 samplen 2 width -4
plot folder."/passes-glass.tsv" using 1:2 with linespoints pt 7 lc rgb "#1f77b4" title "article: pixels with a wrong 8-bit colour", \
    "" using 1:3 with linespoints pt 6 lc rgb "#1f77b4" title "article: mean difference", \
    folder."/passes-mirrors.tsv" using 1:2 with linespoints pt 7 lc rgb "#2ca02c" title "mirror balls: pixels with a wrong 8-bit colour", \
    "" using 1:3 with linespoints pt 6 lc rgb "#2ca02c" title "mirror balls: mean difference"
