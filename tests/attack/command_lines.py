"""Command lines, drawn from the grammar of the commands, then damaged.

Left out are --scheduler (it would ask the network) and more than one job (each line would start
processes).
"""

import string

SIGNS = (
    string.ascii_letters
    + string.digits
    + "+-=:,.*$%#@~ \t\n\"'\\<>&|;(){}[]!?^_`"
    + "äß∞²Ω\u202e\u0000\x1b\udcff😀"
)
WORDS = (
    "", "-", "--", "=", "0", "-1", "1e999", "nan", "inf", "9" * 400, "1" * 5000, "٣:١", "3:1" * 300, "--json=-", "-h", "--help",
    "--csv", "%s%n", "$(id)", "`id`", "{0.__class__}", "\x1b[2J", "a\nb", "../../..", ".", "/dev/full", "/dev/null", "\udcff",
)  # fmt: skip
FILES = ("-", "a.csv", "sub/b.json", "none/c.csv", "/dev/full", "/dev/null", "=1+1.csv")
FOLDERS = ("out", "sub", "sub/deeper", "a.csv")
DATA = ("good.csv", "bad.csv", "good.mat", "none.csv")
SENSORS = ("acceleration", "velocity", "position", "force")
DOMAINS = ("positive", "complex", "real", "general")


def line(draw):
    """The words of one command, half of them damaged."""
    words = draw.choice(COMMANDS)(draw)
    for _ in range(draw.choice((0, 0, 0, 1, 1, 2))):
        words = draw.choice(DAMAGES)(draw, words)
    return tuple(words)


def size(draw):
    return str(draw.choice((1, 1, 2, 2, 2, 3, 3) * 3 + (draw.randrange(-2, 60),)))


def model(draw):
    extras = ("+b1", "+b1", "+b2", "+lag", "+lag", "+delay", "+c", "+b*", "")
    return (
        f"{size(draw)}:{draw.choice((1, 1, 1, 2, 2, 3, 4, 11, draw.randrange(10**9)))}"
        + "".join(draw.choice(extras) for _ in range(draw.choice((0, 0, 1, 2))))
    )


def number(draw):
    return draw.choice(
        (
            str(draw.randrange(-3, 1000)),
            f"{draw.uniform(-2, 1e3):g}",
            "1e-300",
            "1e300",
            "3/4",
            "1/0",
            "0",
            ".5",
        )
    )


def assignments(draw):
    names = ("m1", "m2", "m3", "k01", "k12", "k23", "d12", "b1", "T1", "Td", "zz")
    return ",".join(f"{name}={number(draw)}" for name in draw.sample(names, draw.randrange(1, 8)))


def limits(draw):
    return f"{number(draw)}..{number(draw)}"


def flags(draw, *options):
    """Some of the options; a function draws the value of one."""
    found = []
    for option in options:
        if draw.random() < 0.3:
            name, value = option if isinstance(option, tuple) else (option, None)
            found += [name] if value is None else [name, value(draw)]
    return found


def one_of(*values):
    return lambda draw: draw.choice(values)


def models(draw):
    return [
        "models",
        size(draw),
        *flags(
            draw, "--damped", "--identifiability", "--no-cache", ("--jobs", one_of("1", "0", "x"))
        ),
    ]


def compare(draw):
    options = (
        "--damped",
        "--json",
        "--no-cache",
        ("--quantity", one_of(*SENSORS)),
        ("--domain", one_of(*DOMAINS)),
    )
    more = (
        ("--conditions", one_of("1-9", "1,3", "9-1", "5")),
        ("--bound", lambda d: f"k12={limits(d)}"),
    )
    return ["compare", model(draw), model(draw), *flags(draw, *options, *more)]


def verdicts(draw):
    options = (
        "--damped",
        "--prove",
        ("--quantity", one_of(*SENSORS)),
        ("--domain", one_of(*DOMAINS)),
        ("--markov", one_of("1", "12", "0", "x")),
    )
    more = (
        ("--representation", one_of("tf", "markov", "all")),
        ("--csv", one_of(*FILES)),
        ("--json", one_of(*FILES)),
    )
    return [
        "verdicts",
        draw.choice((size(draw), "1-2", "2-3", "3-1")),
        *flags(draw, *options, *more),
    ]


def equivalents(draw):
    forms = flags(
        draw, "--damped", "--json", "--formulas", "--latex", "--sympy", ("--set", assignments)
    )
    return [
        "equivalents",
        model(draw),
        "--to",
        draw.choice((model(draw), size(draw), "2+b*")),
        *forms,
    ]


def dampers(draw):
    options = (
        "--damped",
        ("--sets", one_of("single", "all")),
        ("--domain", one_of(*DOMAINS)),
        ("--csv", one_of(*FILES)),
    )
    return ["dampers", draw.choice((model(draw), size(draw))), *flags(draw, *options)]


def simulate(draw):
    numbers = tuple(
        (f"--{name}", number)
        for name in ("low", "high", "rms", "rate", "input-noise", "output-noise", "quantum")
    )
    whole = tuple(
        (f"--{name}", lambda d: str(d.randrange(-2, 400)))
        for name in ("samples", "periods", "seed")
    )
    rest = (
        ("--quantity", one_of(*SENSORS)),
        ("--excitation", one_of("schroeder", "chirp", "random-phase")),
    )
    more = (
        ("--set", assignments),
        ("--friction", lambda d: f"{size(d)}={number(d)}"),
        ("--csv", one_of(*FILES)),
        "--damped",
    )
    return [
        "simulate",
        *draw.choice(([], [model(draw)])),
        *flags(draw, *numbers, *whole, *rest, *more),
    ]


def fit(draw):
    source = draw.choice((["--demo"], [draw.choice(DATA)], []))
    masses = draw.choice((["--masses", "1"], ["--masses", "1"], ["--masses", number(draw)]))
    options = (
        ("--band", limits),
        ("--read", lambda d: f"{d.choice(('sensor', 'columns', 'to', 'x'))}={number(d)}"),
    )
    more = (
        ("--fix", assignments),
        ("--bound", lambda d: f"m1={limits(d)}"),
        ("--thresholds", one_of("1,2,3", "1,2", "9,9,0")),
    )
    ports = (
        ("--actuator", one_of("1", "last", "2:1", "x")),
        ("--gap", number),
        ("--sign", one_of("+", "-", "auto")),
        "--family",
    )
    out = (
        ("--json", one_of(*FILES)),
        ("--case", number),
        ("--weights", one_of("std", "coherence", "none")),
        ("--seed", number),
    )
    return ["fit", *source, *masses, *flags(draw, *options, *more, *ports, *out)]


def report(draw):
    return [
        "report",
        *draw.choice(([], ["1"], ["2"], ["1", "2"])),
        *flags(draw, "--damped", "--undamped"),
        "--out",
        "pages",
    ]


def catalog(draw):
    action = draw.choice(("build", "verify", "settle", "none"))
    return [
        "catalog",
        action,
        draw.choice(("1", "1", "2", "x")),
        *flags(draw, ("--out", one_of(*FOLDERS)), ("--catalog", one_of(*FOLDERS))),
    ]


def upkeep(draw):
    return draw.choice(
        (
            ["cache", "info"],
            ["cache", "clear"],
            ["doctor"],
            ["--version"],
            ["--help"],
            ["cache"],
            [],
        )
    )


COMMANDS = (
    models,
    compare,
    compare,
    verdicts,
    equivalents,
    equivalents,
    dampers,
    simulate,
    fit,
    report,
    catalog,
    upkeep,
)


def drop(draw, words):
    at = draw.randrange(len(words) + 1)
    return words[:at] + words[at + 1 :]


def double(draw, words):
    return [*words, draw.choice(words)] if words else words


def swap(draw, words):
    return draw.sample(words, len(words))


def replace(draw, words):
    at = draw.randrange(len(words) + 1)
    return [*words[:at], draw.choice(WORDS), *words[at + 1 :]]


def scratch(draw, words):
    """One word with a few characters removed, put in, or changed; names below / stay as they
    are.
    """
    at = draw.randrange(len(words)) if words else 0
    return [
        _scratched(draw, w) if i == at and not w.startswith("/") else w for i, w in enumerate(words)
    ]


def _scratched(draw, word):
    for _ in range(draw.randrange(1, 4)):
        at = draw.randrange(len(word) + 1)
        word = (
            word[:at]
            + draw.choice(("", draw.choice(SIGNS), draw.choice(SIGNS) * 30))
            + word[at + draw.randrange(2) :]
        )
    return word


DAMAGES = (drop, double, swap, replace, scratch, scratch, scratch)
