"""What veraPDF, the validator of the PDF Association, says about the packages of the projects.

Each package, with its attachments, is checked as PDF/A-3a and as PDF/UA-1. Needs Java and Maven,
which fetches veraPDF 1.28.2 on the first run.

Run from the top: .venv/bin/python tests/bench/standards.py [PROJECT ...]
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FLAVORS = {"3a": "PDF/A-3a", "ua1": "PDF/UA-1"}
POM = """<project><modelVersion>4.0.0</modelVersion>
<groupId>roofslip</groupId><artifactId>standards</artifactId><version>1</version><dependencies>
<dependency><groupId>org.verapdf.apps</groupId><artifactId>greenfield-apps</artifactId>
<version>1.28.2</version></dependency></dependencies></project>"""


def class_path() -> str:
    """Return the class path of veraPDF, fetched once."""
    folder = Path(tempfile.gettempdir()) / "roofslip-verapdf"
    folder.mkdir(exist_ok=True)
    listed = folder / "class-path"
    if not listed.exists():
        (folder / "pom.xml").write_text(POM)
        command = ["mvn", "-q", "dependency:build-classpath", f"-Dmdep.outputFile={listed}"]
        subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return listed.read_text().strip()


def failed(path: Path, flavor: str) -> list[str]:
    """Return the clauses that a file fails; its rules and checks are those of one flavor."""
    judge = "org.verapdf.apps.GreenfieldCliWrapper"
    command = ["java", "-cp", class_path(), judge, "--flavour", flavor, "--format", "text", "-v"]
    said = subprocess.run([*command, str(path)], capture_output=True, text=True, check=False).stdout
    if not re.search(rf"^\W*(\[0m)?(PASS|FAIL) .* {flavor}$", said, re.MULTILINE):
        raise RuntimeError(f"veraPDF did not judge {path}: {said[:500]}")
    return re.findall(r"^\s+FAIL (\S+)", said, re.MULTILINE)


def main() -> None:
    """Report each project and print what its package fails."""
    names = sys.argv[1:] or sorted(p.parent.name for p in ROOT.glob("projects/*/input.xlsx"))
    is_bad = False
    for name in names:
        with tempfile.TemporaryDirectory() as out:
            project = str(ROOT / "projects" / name)
            command = [sys.executable, "-m", "report.cli", "report", project, "--quiet"]
            subprocess.run([*command, "--out", out], cwd=ROOT, check=True)
            package = Path(out) / "calc-package.pdf"
            for flavor, title in FLAVORS.items():
                clauses = failed(package, flavor)
                is_bad |= bool(clauses)
                print(f"{name:12} {title:10} {', '.join(clauses) or 'passes'}", flush=True)
    sys.exit(is_bad)


if __name__ == "__main__":
    main()
