# Time against face count, from the speed.tsv of a run: gnuplot -c plot.gp speed.tsv speed.svg
# Lines are the generated spheres, points the real meshes.
file = ARG1
set terminal svg size 1000,800 enhanced background rgb 'white' font 'sans,13'
set output ARG2
set datafile separator '\t'
set logscale xy
set format x '10^{%L}'
set grid
set key top left font ',10' spacing 0.9
set xrange [5e3:2e7]
set xlabel 'faces'
set ylabel 'ns a query'

columns = "'pierce' 'pierce batch' 'Embree' 'Embree low' 'Bullet' 'CGAL any'"
colours = '#c00000 #f08030 #0050b0 #60a0e0 #409040 #808080'
select(mesh, segments, column) = sprintf( \
    "< awk -F'\\t' '$1 %s /^sphere/ && $3 == \"%s\" && $4 == \"%s\"' '%s' | sort -t '\t' -n -k 2 | { grep . || echo '-\t1e4\t-\t-\tnan'; }", \
    mesh, segments, column, file)

set multiplot layout 2,2
do for [segments in 'short1 medium aimed cloud'] {
    set title segments
    plot for [i = 1:words(columns)] select('~', segments, word(columns, i)) using 2:5 with linespoints pt 7 ps 0.6 lw 2 \
             lc rgb word(colours, i) title word(columns, i), \
         for [i = 1:words(columns)] select('!~', segments, word(columns, i)) using 2:5 with points pt 6 ps 0.8 \
             lc rgb word(colours, i) notitle
}
unset multiplot
