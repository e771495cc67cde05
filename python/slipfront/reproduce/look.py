"""Style of the paper's figures: lines of the friction coefficients, colours of its two events, attributes of coordinates."""

#: Line styles and colours of the three curves of Figs. 8-10: solid, dashed and dotted, as in the captions.
CURVES = (("-", "C0"), ("--", "C1"), (":", "C2"))

#: Colours of the dashed lines by which the paper reads off values: red for Parkfield, green for the ETS event.
RED, GREEN = "#c1272d", "#00843d"

#: Markers of the chain, and of the values that the paper prints.
CHAIN = {"marker": "o", "markersize": 3.2, "color": "black", "markerfacecolor": "white", "linestyle": "none"}
PRINTED = {"marker": "x", "markersize": 6, "color": RED, "linestyle": "none", "markeredgewidth": 1.6}

#: Titles of the columns of a figure with friction.
TITLES = {"paper": "closure “paper”", "consistent": "closure “consistent”"}


def about(long_name, unit="1") -> dict:
    """Returns the attributes of a dimensionless variable. Multiply the variable by `unit` to give it a dimension."""
    return {"long_name": long_name, "units": "1", "dimensional_unit": unit}


FRICTION = about("friction coefficient C")
STRESS = about("initial stress Sigma-", "mu A / pi")
STRESS_RIGHT = about("stress on the right Sigma+", "mu A / pi")
SLIP_VELOCITY = about("slip velocity W at x = 0, t = 2 pi", "c A / pi")
