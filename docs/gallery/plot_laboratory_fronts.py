"""
Front velocity against stress in the laboratory
===============================================

The velocity of slip fronts against the ratio of shear to normal stress, with the curve of the theory
that fits the hardness of the contacts. The table is synthetic.
"""
import slipfront
from slipfront import plots

fronts = slipfront.laboratory(slipfront.cases / "synthetic-laboratory-fronts.csv",
                              poisson_ratio=0.35, p_wave_speed="2700 m/s")
figure = plots.laboratory(fronts)
