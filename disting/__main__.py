"""`python -m disting` is the command line."""

from disting.cli import main

raise SystemExit(main())
