"""Sharp (1982), recomputed: what the paper's figures and claims are made of, and whether they hold."""
