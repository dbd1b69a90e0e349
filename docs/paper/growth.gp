# Run in this folder: gnuplot growth.gp
set terminal svg size 640,440 font 'Helvetica,13' background 'white'
set output 'growth.svg'
set datafile separator ','
set datafile columnheaders
set title 'Cost of an event at constant density'
set xlabel 'number of spheres'
set ylabel 'ns'
set border 3
set tics nomirror out
set key top left reverse Left
set logscale xy
set format xy '10^{%L}'
plot 'growth.csv' using 'n':'paper_ns' with linespoints lw 1.5 pt 5 ps 0.8 lc 1 title 'the paper''s algorithm, per event', \
     'growth.csv' using 'n':'world_ns' with linespoints lw 1.5 pt 7 ps 0.8 lc 2 title 'default engine, per step'
