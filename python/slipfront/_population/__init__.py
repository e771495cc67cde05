"""A hierarchical model of many events: the parts of slipfront.population."""
