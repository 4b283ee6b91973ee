"""The verdict on a pair, on all pairs of a list, and on families of thousands of models.

`query` defines what may decide, `cascade` folds findings into the verdict on a pair, `all_pairs`
those of all pairs at once, `class_search` those of classes; `engine` keeps what was computed in a
store.
"""
