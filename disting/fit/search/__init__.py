"""The best parameters of each candidate: responses, costs, starts, local search."""
