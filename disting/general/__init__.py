"""General parametric models: any rational transfer functions with parameters, with one input and
one output or with several, compared as chains are.
"""
