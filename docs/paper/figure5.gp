# Run in this folder: gnuplot figure5.gp
set terminal svg size 640,440 font 'Helvetica,13' background 'white'
set output 'figure5.svg'
set datafile separator ','
set datafile columnheaders
set title 'Average processing time'
set xlabel 'number of spheres'
set ylabel 'ms per simulated second'
set border 3
set tics nomirror out
set key top left reverse Left
set xrange [0:*]
set yrange [0:*]
plot 'figure5.csv' using 'n':'paper_ms':'paper_ms_low':'paper_ms_high' with yerrorlines lw 1.5 pt 5 ps 0.8 lc 1 title 'the paper''s algorithm', \
     'figure5.csv' using 'n':'world_ms':'world_ms_low':'world_ms_high' with yerrorlines lw 1.5 pt 7 ps 0.8 lc 2 title 'default engine', \
     'figure5.csv' using 'n':'published_ms' with points lw 1.5 pt 9 ps 0.8 lc 3 title 'published (MIPS R10000, 195 MHz)'
