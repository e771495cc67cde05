"""Inference from many events or fronts: slipfront.population and slipfront.laboratory."""
