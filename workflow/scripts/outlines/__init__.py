"""Measured and computed outlines r(z) as scores of a few principal components."""
