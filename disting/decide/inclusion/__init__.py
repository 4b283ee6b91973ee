"""One-sided inclusion: whether the models of one chain are models, or limits of models, of another
one of larger rank.

`decide` compares chains of one size and sends those of different sizes to `across_sizes`;
`confirmation` checks what is found again. What is found, and its text form:
`disting.conditions.inclusion`.
"""
