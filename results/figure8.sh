#!/bin/sh
# Figure 8 of Onoue, Max & Nishita 2004, measured: makes its table, masks and pictures, compares them
# with the committed ones, and takes no parameter. The page is out/reproduced/figure8/report.html.
exec "$(dirname -- "$0")/../gnomon" reproduce --only figure8
