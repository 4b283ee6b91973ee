"""The command line: parse, one call, print. Exit status 0 fine, 1 a failed verification, 2 bad
usage or bad input.
"""

from disting.cli.run import main as main
