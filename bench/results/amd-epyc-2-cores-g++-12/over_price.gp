# Run in this folder: gnuplot over_price.gp
set terminal svg size 640,440 font 'Helvetica,13' background 'white'
set output 'over_price.svg'
set datafile separator ','
set datafile columnheaders
set title 'Detection and motion, the paper''s first scene, 1000 spheres'
set xlabel 'ns per motion step or probe'
set ylabel 'microseconds per sphere and simulated second'
set border 3
set tics nomirror out
set key top left reverse Left
set logscale xy
set format xy '10^{%L}'
plot 'over_price.csv' using 'price_ns':'world' with linespoints lw 1.5 pt 5 ps 0.8 lc 1 title 'default engine', \
     'over_price.csv' using 'price_ns':'tuned_60' with linespoints lw 1.5 pt 7 ps 0.8 lc 2 title 'tuned, 60 steps a second', \
     'over_price.csv' using 'price_ns':'tuned_240' with linespoints lw 1.5 pt 9 ps 0.8 lc 3 title 'tuned, 240 steps a second', \
     'over_price.csv' using 'price_ns':'tuned_1000' with linespoints lw 1.5 pt 11 ps 0.8 lc 4 title 'tuned, 1000 steps a second'
