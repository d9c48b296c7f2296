"""A study's results described as a research object (RO-Crate 1.1): a supplement in one folder."""
