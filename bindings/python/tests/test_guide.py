"""Programs of the guide, as they stand there, and the example of the package's first page."""

import doctest
import re
from pathlib import Path

import motile
import pytest

DOCS = Path(__file__).parents[3] / "docs"
GUIDE = DOCS / "python.md"
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


def test_lines_beside_rust() -> None:
    def lines(program: str, comment: str) -> str:
        stripped = (line.strip() for line in program.splitlines())
        return str(sum(1 for line in stripped if line and not line.startswith(comment)))

    # Programs of the Rust guide that do the same, where there are any.
    others = {"Tables and pictures": "CSV and picture", "A channel with a drive, and films": "A channel with a drive"}
    sections = re.split(r"^## ", (DOCS / "guide.md").read_text(), flags=re.M)
    found = (re.match(r"(.+?)\n.*?^```rust\n(.*?)^```$", section, re.M | re.S) for section in sections)
    rust = dict(match.groups() for match in found if match)
    rows = re.findall(r"^\| (.+?) \| (\d+) \| (\d*) ?\|$", GUIDE.read_text(), flags=re.M)
    expected = []
    for title, program in PROGRAMS:
        other = rust.get(others.get(title, title))
        expected.append((title, lines(program, "#"), lines(other, "//") if other else ""))
    assert rows == expected


def test_notebook() -> None:
    nbformat = pytest.importorskip("nbformat")
    from nbclient import NotebookClient

    notebook = nbformat.read(Path(__file__).parents[1] / "notebook.ipynb", as_version=4)
    NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    kinds = {kind for output in outputs for kind in output.get("data", {})}
    assert {"image/png", "image/svg+xml"} <= kinds and not any(o.output_type == "error" for o in outputs)
