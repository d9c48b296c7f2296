"""The page that a study ends with: loads results, words them, draws them."""
