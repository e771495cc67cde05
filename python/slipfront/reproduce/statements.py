"""What the paper says in words, and what the runs of its figures say to it."""


def table(slip, fronts, drops, relations) -> list:
    """Rows: statement, found (with numbers of this run), holds (True or False).

    slip, fronts: sweeps of Figs. 10 and 12. drops: of Fig. 11. relations: closed form over stress, at the stresses of `fronts`.
    """
    return [trailing(fronts, relations), leading(fronts), *slip_falls(slip), drop(drops), larger(relations)]


def row(statement, found, holds):
    return {"statement": statement, "found": found, "holds": bool(holds)}


def trailing(fronts, relations):
    """The foot of the fast front, measured: exact is only the characteristic that it would follow."""
    velocity = -fronts["trailing_velocity"].sel(closure="consistent")
    off = float(abs(velocity / relations["rupture_velocity"].values - 1).max())
    return row("Rupture velocity does not depend on friction (trailing edge)",
               f"the foot of the slip velocity moves within {100 * off:.1f} % of |V−| for every C and Σ− tried", off < 0.03)


def leading(fronts):
    """The slow front does."""
    velocity = fronts["leading_velocity"].sel(closure="consistent")
    share = float((velocity.isel(coefficient=-1) / velocity.isel(coefficient=0)).min())
    return row("Rupture velocity does not depend on friction (leading edge)",
               f"with C = {float(fronts['coefficient'][-1]):g} down to {100 * share:.0f} % of that without friction (consistent closure)", share > 0.99)


def slip_falls(slip):
    """Slip velocity falls with friction, by a factor that hardly depends on the stress."""
    share = slip["slip_velocity_at_origin"] / slip["slip_velocity_at_origin"].isel(coefficient=0)
    paper, right = (share.sel(closure=closure).isel(coefficient=-1) for closure in ("paper", "consistent"))
    c = float(slip["coefficient"][-1])
    low, high = float(slip["stress"].min()), float(slip["stress"].max())
    spread = [float(one.max() / one.min()) for one in (paper, right)]
    change = slip["slip_velocity_at_origin"].sel(closure="paper").isel(coefficient=0)
    factor = float(change.max() / change.min())
    return [row("Slip velocity depends on friction", f"W(0) at C = {c:g} is {100 * float(paper.min()):.0f} to {100 * float(paper.max()):.0f} % of that without (paper), "
                f"{100 * float(right.min()):.0f} to {100 * float(right.max()):.0f} % (consistent)", float(paper.max()) < 0.9),
            row("By a factor that depends weakly on Σ−", f"from Σ− = {low:g} to {high:g} it changes {spread[0]:.2f} times (paper), {spread[1]:.2f} times (consistent), while W(0) itself "
                f"changes {factor:.0f} times", max(spread) < factor**0.25)]


def drop(drops):
    """Slip velocity against the stress drop."""
    w = drops["slip_velocity_at_origin"]
    shares = (w.isel(relative_drop=0) / w.isel(relative_drop=-1)).to_series()
    if w["relative_drop"][0] > w["relative_drop"][-1]:
        shares = 1 / shares
    text = ", ".join(f"{100 * share:.0f} % ({state})" for state, share in shares.items())
    return row("W(0) does not depend on Σ+ for stress drops of 35 to 100 %", f"at a drop of 35 %, as a share of that at 100 %: {text}", shares.min() > 0.95)


def larger(relations):
    """Both edges without friction."""
    ratio = relations["velocity_ratio"]
    return row("|V−| is always larger than V+", f"{float(ratio.min()):.2f} to {float(ratio.max()):.3g} times, Σ− = {float(relations['stress'].min()):g} to "
               f"{float(relations['stress'].max()):g}, closed form", ratio.min() > 1)
