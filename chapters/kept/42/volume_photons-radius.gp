# gnuplot volume_photons-radius.gp; scripts/plot does it for a folder.
set terminal svg size 720,400 dynamic font 'sans-serif,14' linewidth 1.6
set output 'volume_photons-radius.svg'
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
set xlabel 'radius in half widths of the beam' noenhanced
set ylabel 'relative error' noenhanced
set logscale x
set format x '10^{%L}'
set logscale y
set format y '10^{%L}'

plot 'volume_photons-radius.csv' using 1:2 with linespoints lt 1 lw 2.5 pt 7 ps 0.35 title columnheader(2), 'volume_photons-radius.csv' using 1:3 with linespoints lt 2 pt 7 ps 0.35 title columnheader(3), 'volume_photons-radius.csv' using 1:4 with linespoints lt 3 pt 7 ps 0.35 title columnheader(4)
