"""The paper, reproduced: every number and figure, computed in one run."""
