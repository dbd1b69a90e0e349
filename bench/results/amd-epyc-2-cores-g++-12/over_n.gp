# Run in this folder: gnuplot over_n.gp
set terminal svg size 640,440 font 'Helvetica,13' background 'white'
set output 'over_n.svg'
set datafile separator ','
set datafile columnheaders
set title 'Detection, spheres as dense as 1000 in the paper''s box, first 0.2 s'
set xlabel 'number of spheres'
set ylabel 'microseconds per sphere and simulated second'
set border 3
set tics nomirror out
set key top left reverse Left
set logscale xy
set format xy '10^{%L}'
plot 'over_n.csv' using 'n':'world' with linespoints lw 1.5 pt 5 ps 0.8 lc 1 title 'default engine', \
     'over_n.csv' using 'n':'tuned_60' with linespoints lw 1.5 pt 7 ps 0.8 lc 2 title 'tuned, 60 steps a second', \
     'over_n.csv' using 'n':'tuned_240' with linespoints lw 1.5 pt 9 ps 0.8 lc 3 title 'tuned, 240 steps a second', \
     'over_n.csv' using 'n':'tuned_1000' with linespoints lw 1.5 pt 11 ps 0.8 lc 4 title 'tuned, 1000 steps a second'
