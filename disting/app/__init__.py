"""Local app: `disting app` serves one page to the browser of this machine.

The server owns addresses and safety (`server`, `gate`), the workers own the computation
(`workers`, `jobs`), and the page talks to the engine only through the table in `interface`, JSON in
and JSON out. State is a folder that a person can read (`project`).
"""
