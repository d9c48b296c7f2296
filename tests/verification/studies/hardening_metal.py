"""Which metal hardens: softer metal becomes a disc, which no network follows well, and which costs
a 3D run ten minutes."""

HARDENING = {"hardening_coefficient": 1, "immobilization_velocity": 0.2}  # above
