# gnuplot break_it-brightness.gp; scripts/plot does it for a folder.
set terminal svg size 720,400 dynamic font 'sans-serif,14' linewidth 1.6
set output 'break_it-brightness.svg'
set datafile separator ','
set datafile missing ''
set border 3
set tics nomirror out
set grid lc rgb '#80808080' lw 0.4
set key outside top horizontal center noenhanced
set linetype 1 lc rgb '#3b8ed0'
set linetype 2 lc rgb '#e0752d'
set linetype 3 lc rgb '#2fa36b'
set linetype 4 lc rgb '#a06cd5'
set linetype 5 lc rgb '#d64550'
set linetype 6 lc rgb '#8c8c3a'
set xlabel 'tolerance of the mean brightness (%)' noenhanced
set ylabel 'mistakes that are found (%)' noenhanced
set logscale x
set format x '10^{%L}'
set yrange [0:100]
set key off

plot 'break_it-brightness.csv' using 1:2 with linespoints lt 1 lw 2.5 pt 7 ps 0.35 title columnheader(2)
