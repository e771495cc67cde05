"""Style of the paper's figures: lines, colours, attributes of coordinates."""

from .._dataset import about

#: Line styles and colours of the three curves of Figs. 8-10: solid, dashed dotted.
CURVES = (("-", "C0"), ("--", "C1"), (":", "C2"))

#: Colours of the values that the paper reads off: red for Parkfield, green for the ETS event.
RED, GREEN = "#c1272d", "#00843d"

#: Markers of the chain, and of the values that the paper prints.
CHAIN = {"marker": "o", "markersize": 3.2, "color": "black", "markerfacecolor": "white",
         "linestyle": "none"}
PRINTED = {"marker": "x", "markersize": 6, "color": RED, "linestyle": "none",
           "markeredgewidth": 1.6}

#: Titles of the columns of a figure with friction.
TITLES = {"paper": "closure “paper”", "consistent": "closure “consistent”"}

FRICTION = about("friction coefficient C")
STRESS = about("initial stress Sigma-", "mu A / pi")
STRESS_RIGHT = about("stress on the right Sigma+", "mu A / pi")
SLIP_VELOCITY = about("slip velocity W at x = 0, t = 2 pi", "c A / pi")
