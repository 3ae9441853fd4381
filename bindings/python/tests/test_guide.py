"""Programs of the guide, as they stand there, and the example of the package's first page."""

import doctest
import re
from pathlib import Path

import motile
import pytest

GUIDE = Path(__file__).parents[3] / "docs" / "python.md"
PROGRAMS = re.findall(r"^## (.+?)$.*?^```python\n(.*?)^```$", GUIDE.read_text(), flags=re.M | re.S)


def test_there_are_ten() -> None:
    assert len(PROGRAMS) == 10


@pytest.mark.parametrize(("title", "program"), PROGRAMS, ids=[title for title, _ in PROGRAMS])
def test_program(title: str, program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(program, title, "exec"), {"__name__": "__main__"})


def test_first_page() -> None:
    failures, count = doctest.testmod(motile)
    assert count > 0 and not failures
