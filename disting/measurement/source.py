"""Files with measured data: each is read once, and never without a bound."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from disting.errors import InputError, short
from disting.files import read_bounded

LARGEST = 512_000_000  # bytes of a file, and of what is unpacked from it
WANTED = "a file that holds the frequency response alone, or fewer lines"


@dataclass(frozen=True, slots=True)
class Source:
    """The name of a file, for messages, and its bytes."""

    name: str
    content: bytes = field(repr=False)

    @property
    def suffix(self) -> str:
        """The ending of the name, in small letters."""
        return Path(self.name).suffix.lower()


def source(path: str | Path) -> Source:
    """A file, pipe or device with measured data; raises InputError where there is none, or more
    than 512 MB.
    """
    file = Path(path)
    if file.is_dir():
        raise InputError(f"{file} is a folder; name a file with measured data")
    if not file.exists():
        raise InputError(f"there is no file {file}; check its name and folder")
    return Source(file.name, read_bounded(file, WANTED, LARGEST))


@dataclass(frozen=True, slots=True)
class Allowance:
    """Limit of what may be unpacked from one file in total: `took` by name, as it is requested."""

    origin: str
    took: dict[str, int] = field(default_factory=dict)

    def take(self, name: str, size: int) -> None:
        """Count the bytes stated in a header; raises InputError before they are unpacked where they
        are too many.
        """
        self.took[name] = size
        if sum(self.took.values()) > LARGEST:
            raise InputError(
                f"{self.origin}: {short(name)} unpacks to {size // 10**6} MB, more than"
                f" {LARGEST // 10**6} MB are not read; name {WANTED}"
            )


Take = Callable[[str, int], None]
