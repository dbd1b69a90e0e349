# Run in this folder: gnuplot over_rate.gp
set terminal svg size 640,440 font 'Helvetica,13' background 'white'
set output 'over_rate.svg'
set datafile separator ','
set datafile columnheaders
set title 'Detection, the paper''s first scene, 1000 spheres'
set xlabel 'steps per simulated second'
set ylabel 'microseconds per sphere and simulated second'
set border 3
set tics nomirror out
set key top left reverse Left
set logscale xy
set format xy '10^{%L}'
plot 'over_rate.csv' using 'rate':'world' with linespoints lw 1.5 pt 5 ps 0.8 lc 1 title 'default engine (no steps)', \
     'over_rate.csv' using 'rate':'tuned' with linespoints lw 1.5 pt 7 ps 0.8 lc 2 title 'tuned', \
     'over_rate.csv' using 'rate':'swept' with linespoints lw 1.5 pt 9 ps 0.8 lc 3 title 'tuned, swept', \
     'over_rate.csv' using 'rate':'bullet' with linespoints lw 1.5 pt 11 ps 0.8 lc 4 title 'Bullet', \
     'over_rate.csv' using 'rate':'fcl' with linespoints lw 1.5 pt 13 ps 0.8 lc 5 title 'FCL'
