// SPDX-License-Identifier: BSD-3-Clause
#include "plot_script.h"

namespace edgevo {

std::string plot_script() {
  return R"gnuplot(# Draws the plots of `edgevo study` from the tables in this folder, as PNG and SVG:  gnuplot plots.gnuplot
set datafile separator ","
set datafile missing NaN
set encoding utf8

# One line style a method, the same in all plots.
set style line 1 lc rgb "#1f5fa8" lw 2.2 pt 7 ps 0.8    # gradient
set style line 2 lc rgb "#e07b00" lw 1.6 pt 5 ps 0.7    # intensity
set style line 3 lc rgb "#2e8b3d" lw 1.6 pt 9 ps 0.8    # census
set style line 4 lc rgb "#808080" lw 1.6 pt 11 ps 0.8   # edge matches
set style line 5 lc rgb "#c62828" lw 1.6 pt 13 ps 0.9   # pyramidal Lucas-Kanade
set style line 6 lc rgb "#7b4fa3" lw 1.6 pt 15 ps 0.7   # epipolar flow
set style line 7 lc rgb "#000000" lw 1.2 dt 2 pt 1 ps 0.6
set style line 8 lc rgb "#b0b0b0" lw 1.0 dt 3
set border 3 lc rgb "#404040"
set tics nomirror out
set grid ytics lc rgb "#dddddd" lw 0.5 lt 1

pick(light, method, value) = (strcol(1) eq light && strcol(2) eq method) ? value : NaN
pick3(light, method, measure, value) = (strcol(1) eq light && strcol(2) eq method && strcol(3) eq measure) ? value : NaN
title_of(light) = light eq "normal" ? "normal light" : "changed light"

array file[2] = ["png", "svg"]
terminal_for(format, w, h) = format eq "png" \
  ? sprintf("pngcairo size %d,%d font 'DejaVu Sans,13' background 'white'", 1.6*w, 1.6*h) \
  : sprintf("svg size %d,%d font 'DejaVu Sans,9' background 'white' dynamic", w, h)

set_k_tics = 'set xtics ("0" 0, "0.25" 1, "0.5" 2, "1" 3, "2" 4, "4" 5, "max" 6); set xrange [-0.3:6.3]'
set_patch_tics = 'set xtics ("3" 0, "5" 1, "7" 2, "9" 3, "11" 4, "adaptive" 5); set xrange [-0.3:5.3]'
set_distance_tics = 'set xtics autofreq; set xrange [0.7:*]'
costs = "gradient intensity census"
all_methods = "gradient intensity census edge_matches lucas_kanade epipolar_flow"
all_titles = "gradient intensity census 'edge matches' Lucas-Kanade 'epipolar flow'"

do for [f = 1:2] {
  # ---- against search length, patch size and frame distance (the paper's Fig. paramstudy): drift, then direction
  do for [figure in "paramstudy direction"] {
    measure = figure eq "paramstudy" ? 7 : 11
    name = figure eq "paramstudy" ? "mean drift, %" : "direction error, degrees"
    eval("set terminal " . terminal_for(file[f], 760, 800))
    set output figure . "." . file[f]
    set multiplot layout 3,2 margins 0.085,0.985,0.065,0.955 spacing 0.085,0.095
    set ylabel name offset 1
    set yrange [0:*]
    set key bottom left samplen 2
    eval(set_k_tics)
    do for [light in "normal changed"] {
      set title title_of(light)
      set xlabel "search length ratio k (0: edge matches, max: fixed length)"
      plot for [m = 1:3] "search_length.csv" using (pick(light, word(costs, m), column(4))):(column(measure)) with linespoints ls m \
             title word(costs, m)
    }
    unset title
    unset key
    eval(set_patch_tics)
    set xlabel "patch size, pixels"
    do for [light in "normal changed"] {
      plot for [m = 1:3] "patch_size.csv" using (pick(light, word(costs, m), column(4))):(column(measure)) with linespoints ls m
    }
    eval(set_distance_tics)
    set xlabel "frames between host and target"
    set logscale y
    if (measure == 7) { set yrange [0.3:600] } else { set yrange [0.03:1000] }
    set key top left samplen 2 maxrows 3
    do for [light in "normal changed"] {
      plot for [m = 1:6] "frame_distance.csv" using (pick(light, word(all_methods, m), column(4))):(column(measure)) with linespoints ls m \
             title word(all_titles, m)
      unset key
    }
    unset logscale y
    unset multiplot
  }

  # ---- CPU time
  eval("set terminal " . terminal_for(file[f], 900, 300))
  set output "time." . file[f]
  set multiplot layout 1,3 margins 0.06,0.985,0.17,0.9 spacing 0.07,0.1
  set ylabel "matching, CPU ms a pair" offset 1
  set yrange [0:*]
  set key top left samplen 2
  set title "search length"
  set xlabel "search length ratio k"
  eval(set_k_tics)
  plot for [m = 1:3] "search_length.csv" using (pick("normal", word(costs, m), column(4))):16 with linespoints ls m title word(costs, m)
  unset key
  set title "patch size"
  set xlabel "patch size, pixels"
  eval(set_patch_tics)
  plot for [m = 1:3] "patch_size.csv" using (pick("normal", word(costs, m), column(4))):16 with linespoints ls m
  eval(set_distance_tics)
  set title "frame distance"
  set xlabel "frames between host and target"
  set logscale y
  set yrange [0.05:3000]
  set key top left maxrows 3 samplen 2
  plot for [m = 1:6] "frame_distance.csv" using (pick("normal", word(all_methods, m), column(4))):16 with linespoints ls m \
         title word(all_titles, m)
  unset logscale y
  unset multiplot

  # ---- errors of single matches
  eval("set terminal " . terminal_for(file[f], 760, 330))
  set output "match_errors." . file[f]
  set multiplot layout 1,2 margins 0.08,0.985,0.155,0.91 spacing 0.085,0.1
  set ylabel "share of matches with a smaller error" offset 1
  set xlabel "end-point error, pixels"
  set yrange [0:1]
  set xrange [0.05:100]
  set logscale x
  set xtics 0.1,10,100
  set key bottom right samplen 2 maxrows 6
  do for [light in "normal changed"] {
    set title title_of(light)
    set arrow 1 from 2, graph 0 to 2, graph 1 nohead ls 8
    plot "match_errors.csv" using (pick(light, "photometric_2d_refined", column(3))):4 with lines ls 1 dt 2 title "gradient, refined", \
         "" using (pick(light, "photometric_2d", column(3))):4 with lines ls 1 title "gradient", \
         "" using (pick(light, "intensity_2d", column(3))):4 with lines ls 2 title "intensity", \
         "" using (pick(light, "census_2d", column(3))):4 with lines ls 3 title "census", \
         "" using (pick(light, "epipolar_flow", column(3))):4 with lines ls 6 title "epipolar flow", \
         "" using (pick(light, "lucas_kanade", column(3))):4 with lines ls 5 title "Lucas-Kanade"
    unset key
  }
  unset arrow 1
  unset logscale x
  unset multiplot

  # ---- confidences
  eval("set terminal " . terminal_for(file[f], 760, 620))
  set output "confidence." . file[f]
  set multiplot layout 2,2 margins 0.08,0.985,0.085,0.945 spacing 0.085,0.12
  set xrange [0:1]
  set xtics 0,0.2,1
  set ylabel "precision"
  set xlabel "recall"
  set yrange [0.6:1.01]
  set key bottom left samplen 2 maxrows 6
  set title "C_m against the end-point error"
  plot for [m = 1:3] "confidence.csv" using (pick3("normal", word("gradient intensity census", m), "C_m", column(7))):6 with lines ls m \
         title word("gradient intensity census", m), \
       for [m = 1:3] "" using (pick3("changed", word("gradient intensity census", m), "C_m", column(7))):6 with lines ls m dt 2 \
         title word("gradient intensity census", m) . ", changed light"
  set title "C_d against the depth error"
  plot "confidence.csv" using (pick3("normal", "edge_matches", "C_d", column(7))):6 with lines ls 1 title "edge matches", \
       "" using (pick3("changed", "edge_matches", "C_d", column(7))):6 with lines ls 1 dt 2 title "edge matches, changed light"
  unset title
  unset key
  set xlabel "density: share of the matches kept"
  set ylabel "error rate of the kept ones"
  set yrange [0:*]
  plot for [m = 1:3] "confidence.csv" using (pick3("normal", word("gradient intensity census", m), "C_m", column(4))):5 with lines ls m, \
       for [m = 1:3] "" using (pick3("changed", word("gradient intensity census", m), "C_m", column(4))):5 with lines ls m dt 2
  plot "confidence.csv" using (pick3("normal", "edge_matches", "C_d", column(4))):5 with lines ls 1, \
       "" using (pick3("changed", "edge_matches", "C_d", column(4))):5 with lines ls 1 dt 2
  unset multiplot
  set output
}
)gnuplot";
}

}  // namespace edgevo
