# Run in this folder: gnuplot figure6.gp
set terminal svg size 640,440 font 'Helvetica,13' background 'white'
set output 'figure6.svg'
set datafile separator ','
set datafile columnheaders
set title 'The number of actual events'
set xlabel 'number of spheres'
set ylabel 'events'
set border 3
set tics nomirror out
set key top left reverse Left
set xrange [0:*]
set yrange [0:*]
plot 'figure6.csv' using 'n':'colliding' with linespoints lw 1.5 pt 5 ps 0.8 lc 1 title 'colliding', \
     'figure6.csv' using 'n':'entering' with linespoints lw 1.5 pt 7 ps 0.8 lc 2 title 'entering', \
     'figure6.csv' using 'n':'leaving' with linespoints lw 1.5 pt 9 ps 0.8 lc 3 title 'leaving', \
     'figure6.csv' using 'n':'resetting' with linespoints lw 1.5 pt 11 ps 0.8 lc 4 title 'resetting'
