# Run in this folder: gnuplot figure7b.gp
set terminal pngcairo size 440,420 font 'Helvetica,13' background 'white'
set output 'figure7b.png'
set datafile separator ','
set datafile columnheaders
set title 'spheres at t = 2 s'
set xrange [0:200]
set yrange [0:200]
set cbrange [0:200]
set size ratio -1
set palette defined (0 '#1f5fa8', 1 '#dbe8f6')
unset colorbox
unset key
set tics nomirror out
plot 'figure7b.csv' using 'x':'z':'radius':'y' with circles lc palette lw 0.3 fs solid border lt -1
