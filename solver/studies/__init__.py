"""Studies: many cases of slope, friction and intensity under many motions, and their statistics.

Reads and writes no files. Read `curves` and `fragility` for the results, `grid` and `runs` for the
runs behind them.
"""
