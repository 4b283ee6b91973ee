"""What verdicts rest on, small enough to be stored with them and to be checked again alone.

A kind of evidence is a class here: its fields, its sentence, its formula. `kinds` says which of
them verdicts, inclusions and findings on positive parameters may rest on, `plain` how they are
stored. They are checked anew where the means are: `questions.same.evidence_check`,
`questions.inclusion.confirmation`, `questions.positive.confirmation`, `general.certificate`.
"""
