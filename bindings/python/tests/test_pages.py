"""Programs of the pages: all blocks of Python of a page are one program, which runs in a new folder."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", *(ROOT / "docs").glob("*/*.md")]
PROGRAMS = {
    str(page.relative_to(ROOT)): "\n".join(blocks)
    for page in PAGES
    if (blocks := re.findall(r"^```python\n(.*?)^```$", page.read_text(), flags=re.M | re.S))
}


def test_pages_have_programs() -> None:
    assert {"README.md", "docs/tutorials/first-swimmer-python.md"} <= set(PROGRAMS)


@pytest.mark.parametrize("page", sorted(PROGRAMS))
def test_program(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(PROGRAMS[page], page, "exec"), {"__name__": "__main__"})
