"""What the paper's figures share: line styles of the friction coefficients, colours of its two events, attributes of coordinates."""

#: Line styles and colours of the three curves of Figs. 8-10: solid, dashed, dotted, as the captions have them.
CURVES = (("-", "C0"), ("--", "C1"), (":", "C2"))

#: The paper's dashed read-offs: red for Parkfield, green for the ETS event.
RED, GREEN = "#c1272d", "#00843d"

#: Dots of the chain, and of what the paper prints.
CHAIN = {"marker": "o", "markersize": 3.2, "color": "black", "markerfacecolor": "white", "linestyle": "none"}
PRINTED = {"marker": "x", "markersize": 6, "color": RED, "linestyle": "none", "markeredgewidth": 1.6}

#: Titles of the columns of a figure with friction.
TITLES = {"paper": "closure “paper”", "consistent": "closure “consistent”"}


def about(long_name, unit="1") -> dict:
    """Attributes of a dimensionless variable; `unit` is what to multiply it by."""
    return {"long_name": long_name, "units": "1", "dimensional_unit": unit}


FRICTION = about("friction coefficient C")
STRESS = about("initial stress Sigma-", "mu A / pi")
STRESS_RIGHT = about("stress on the right Sigma+", "mu A / pi")
SLIP_VELOCITY = about("slip velocity W at x = 0, t = 2 pi", "c A / pi")
