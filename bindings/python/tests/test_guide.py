"""Programs of the page on Python beside those in Rust (`tests/rust`), and the example of the package's first page."""

import doctest
import json
import re
import subprocess
from pathlib import Path

import motile
import numpy as np
import pytest

DOCS = Path(__file__).parents[3] / "docs"
GUIDE = DOCS / "reference/python.md"
SECTIONS = re.split(r"^## ", GUIDE.read_text(), flags=re.M)
MATCHES = (re.match(r"(.+?)\n.*?^```python\n(.*?)^```$", section, re.M | re.S) for section in SECTIONS)
PROGRAMS = [match.groups() for match in MATCHES if match]


def in_rust() -> dict[str, str]:
    """Programs in Rust that do the same, by the titles of the page."""
    place = Path(__file__).parent / "rust"
    return {title: (place / f"{re.sub('[^a-z]+', '_', title.lower())}.rs").read_text() for title, _ in PROGRAMS}


@pytest.fixture(scope="module")
def printed_in_rust(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """What the programs in Rust print, with all digits: one program of all, beside the crates of an example."""
    command = "cargo build --release --quiet --example bifurcation --message-format json"
    built = subprocess.run(command.split(), cwd=DOCS.parent, check=True, capture_output=True, text=True).stdout
    messages = [json.loads(line) for line in built.splitlines()]
    files = {m["target"]["name"]: m["filenames"][0] for m in messages if m["reason"] == "compiler-artifact"}
    crates = ["motile", "motile_output", "motile_steady_states"]
    place = tmp_path_factory.mktemp("rust")
    programs = list(in_rust().values())
    modules = [f"mod p{k} {{ {p.replace('fn main', 'pub fn main')} }}" for k, p in enumerate(programs)]
    calls = [f'println!("== "); p{k}::main().unwrap();' for k in range(len(programs))]
    text = "\n".join([*modules, "fn main() {", *calls, "}"])
    (place / "all.rs").write_text(re.sub(r"(\{\w*):\.\d+e?\}", r"\1:.17e}", text))
    extern = [f"--extern={name}={files[name]}" for name in crates]
    compiler = ["rustc", "--edition=2024", "-Copt-level=3", f"-Ldependency={Path(files['motile']).parent}", *extern]
    subprocess.run([*compiler, "all.rs"], cwd=place, check=True)
    out = subprocess.run([place / "all"], cwd=place, check=True, capture_output=True, text=True).stdout
    return dict(zip(in_rust(), out.split("== ")[1:], strict=True))


def numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)]


def test_there_are_ten() -> None:
    assert len(PROGRAMS) == 10


@pytest.mark.parametrize(("title", "program"), PROGRAMS, ids=[title for title, _ in PROGRAMS])
def test_program(
    title: str,
    program: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
    printed_in_rust: dict[str, str],
) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(re.sub(r":\.\d+[ef]\}", ":.17g}", program), title, "exec"), {"__name__": "__main__"})
    printed = numbers(capfd.readouterr().out)
    # Rust prints more: each number here is the next one there that is the same.
    others = iter(numbers(printed_in_rust[title]))
    missing = [number for number in printed if not any(np.isclose(number, o, rtol=1e-12, atol=1e-12) for o in others)]
    assert printed and not missing, printed_in_rust[title]


def test_first_page() -> None:
    failures, count = doctest.testmod(motile)
    assert count > 0 and not failures

