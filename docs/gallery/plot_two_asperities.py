"""
Two asperities and a barrier
============================

Two asperities are apart by a region that strengthens. They break together or one after the other,
as the strength of that barrier decides.
"""
import slipfront
from slipfront import plots

fault = slipfront.chain(slipfront.cases / "two-asperities.toml", set={"chain.spacing": "500 m"})
figure = plots.loading(fault)
