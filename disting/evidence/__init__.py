"""Evidence of verdicts, small enough to be stored with them and to be checked again on its own.

A kind of evidence is a class here, which defines it completely: its fields, how they are stored,
its words, which rules may carry it and what it shows (`kind`). `kinds` lists those that verdicts
and inclusions may rest on. How each is checked again is given by the tables of `disting.decide`.
"""
