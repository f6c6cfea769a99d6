# What a bake costs against its radius and against the size of its map, from the benchmark's CSV:
#   gnomon_bake_benchmark --benchmark_filter='^(radius|size)/' --benchmark_out=bake_cost.csv
#     --benchmark_out_format=csv
#   sed -n '/^name,/,$p' bake_cost.csv > results/speed/bake_cost.csv
#   gnuplot -c tests/benchmarks/bake_cost.gp results/speed/bake_cost.csv results/speed/bake_cost.svg
set datafile separator comma
set terminal svg size 900,360 dynamic font "sans-serif,13"
set output ARG2
set key autotitle columnhead
unset key
set logscale xy
set grid
set multiplot layout 1,2
azimuths = 32
# The fastest of the runs of each value: other programs only ever add time.
nanoseconds(kind) = strstrt(strcol("name"), kind . "/") == 1 ? 1e9 / column("horizons/s/core") : NaN
set title "Cost of a horizon against the radius, 512² texels"
set xlabel "radius, texels"
set ylabel "ns a horizon, one core"
set xrange [6:6000]
set xtics (8, 32, 128, 512, 2048)
set yrange [1:1000]
plot ARG1 using (column("radius")):(nanoseconds("radius")) with linespoints pointtype 7 lc rgb "#0060a0"
set title "Cost of a bake against the map, radius 128"
set xlabel "side of the map, texels"
set ylabel "seconds for 32 azimuths, one core"
set xrange [100:2600]
set xtics (128, 256, 512, 1024, 2048)
set yrange [*:*]
seconds(kind) = nanoseconds(kind) * 1e-9 * azimuths * column("size")**2
plot ARG1 using (column("size")):(seconds("size")) with linespoints pointtype 7 lc rgb "#0060a0"
unset multiplot
