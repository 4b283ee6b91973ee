"""Separate processes for the tests of the store: python store_worker.py TASK PATH [ARGUMENT...].

Every task prints plain lines; "warnings N" is the number of cache warnings the process has seen.
"""

import hashlib
import os
import random
import resource
import sqlite3
import sys
import warnings
from importlib import import_module
from pathlib import Path

from disting.store.store import CacheWarning, Store


def key(number: int) -> str:
    """The key of the numbered value."""
    return hashlib.sha256(str(number).encode()).hexdigest()


def value(number: int) -> str:
    """A value that follows from its number, of 40 to 3000 characters."""
    return f'{{"number": {number}, "digits": "{key(number) * (1 + number % 47)}"}}'


def items(numbers: range) -> dict[str, str]:
    """Keys and values of the numbers."""
    return {key(number): value(number) for number in numbers}


def say(text: object) -> None:
    """One write call, so that a line printed before a kill is printed whole."""
    os.write(1, f"{text}\n".encode())


def count(path: str) -> None:
    """Continue from the first missing number for ever, printing each number after its commit."""
    store, number = Store.open(path), 0
    while store.get_many([key(number)]):
        number += 1
    say(f"from {number}")
    while True:
        store.put_many({key(number): value(number)})
        say(f"done {number}")
        number += 1


def create(path: str) -> None:
    """Remove and create the database for ever."""
    say("ready")
    while True:
        Path(path).unlink(missing_ok=True)
        Store.open(path).put_many(items(range(3)))


def share(path: str, seed: str, rounds: str) -> None:
    """Read and write the same 200 keys as all others, and print how many values were wrong."""
    chance, wrong = random.Random(seed), 0
    store = Store.open(path)
    for _ in range(int(rounds)):
        numbers = chance.sample(range(200), 8)
        found = store.get_many(map(key, numbers))
        wrong += sum(found.get(key(number), value(number)) != value(number) for number in numbers)
        store.put_many({key(number): value(number) for number in numbers[:3]})
        wrong += len(store.get_many(map(key, numbers[:3]))) != 3
    say(f"wrong {wrong}")


def churn(path: str, rounds: str) -> None:
    """Remove, create and use the database, while others do the same."""
    wrong = 0
    for _ in range(int(rounds)):
        Path(path).unlink(missing_ok=True)
        with Store.open(path) as store:
            store.put_many(items(range(3)))
            wrong += not store.get_many(items(range(3))).items() <= items(range(3)).items()
    say(f"wrong {wrong}")


def meet(path: str, number: str) -> None:
    """Wait for the start signal, use the store, and print the warnings."""
    say("ready")
    sys.stdin.readline()
    store = Store.open(path, wait_seconds=60)  # a busy machine takes its time
    store.put_many({key(int(number)): value(int(number))})
    say(f"kept {store.get_many([key(int(number))]) == {key(int(number)): value(int(number))}}")


def hold(path: str) -> None:
    """Hold the write lock until a line comes in."""
    connection = sqlite3.connect(path, isolation_level=None)
    connection.execute("BEGIN IMMEDIATE")
    say("held")
    sys.stdin.readline()
    connection.execute("COMMIT")


def use(path: str) -> None:
    """Use the store twice, and print how many of the entries of a full cache it gives."""
    store = Store.open(path)
    store.put_many(items(range(400)))
    say(f"found {len(store.get_many(items(range(400))))}")
    store.put_many(items(range(400)))


def limited(path: str, size: str) -> None:
    """Use the store while no file may grow beyond a size in bytes, as on a full disk."""
    sys.dont_write_bytecode = True  # a compiled module would stay cut off
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(size), int(size)))
    use(path)


def nobody(path: str) -> None:
    """Use the store without the rights of the owner."""
    if os.getuid() == 0:
        # an interpreter below the home of root hides from others what is imported when used
        Path(path).as_uri()
        for late in ("filelock", "importlib.metadata", "platformdirs"):
            import_module(late)
        os.setgroups([])
        os.setgid(65534)
        os.setuid(65534)
    use(path)


def main() -> None:
    """Run the task named on the command line."""
    tasks = (count, create, share, churn, meet, hold, use, limited, nobody)
    named = {task.__name__: task for task in tasks}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        named[sys.argv[1]](*sys.argv[2:])
    say(f"warnings {sum(issubclass(item.category, CacheWarning) for item in caught)}")


if __name__ == "__main__":
    main()
