"""Claim: the packages of three projects are PDF/A-3a and PDF/UA-1, verify, and tell tampering.

veraPDF, the validator of the PDF Association, checks each package with its attachments; Maven
fetches it on the first run, and without Java and Maven there are no figures of it. Then each
package is verified as written, and tampered with by seed in every way of
`tests/fixtures/tampering.py`.
"""

import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import ROOT, SMOKE, command, figure, finished

from fixtures import tampering

PROJECTS = ("conditions", "example", "school")
KINDS = (*tampering.OF_THE_FILE, *tampering.OF_THE_INPUT, *tampering.OF_THE_SOFTWARE)
COUNT = 2 if SMOKE else len(KINDS)
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
        build = ["mvn", "-q", "dependency:build-classpath", f"-Dmdep.outputFile={listed}"]
        subprocess.run(build, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return listed.read_text().strip()


def failed(path: Path, flavor: str) -> list[str]:
    """Return the clauses that a file fails; its rules and checks are those of one flavor."""
    judge = "org.verapdf.apps.GreenfieldCliWrapper"
    words = ["java", "-cp", class_path(), judge, "--flavour", flavor, "--format", "text", "-v"]
    said = subprocess.run([*words, str(path)], capture_output=True, text=True, check=False).stdout
    if not re.search(rf"^\W*(\[0m)?(PASS|FAIL) .* {flavor}$", said, re.MULTILINE):
        raise RuntimeError(f"veraPDF did not judge {path}: {said[:500]}")
    return re.findall(r"^\s+FAIL (\S+)", said, re.MULTILINE)


def verified(path: Path) -> int:
    """Return the exit code of `roofslip verify-package`."""
    words = command("verify-package", str(path), "--quiet")
    return subprocess.run(words, cwd=ROOT, capture_output=True, check=False).returncode


def standards(packages: dict[str, Path]) -> int:
    """Print how many clauses of each standard the packages fail; return their sum."""
    clauses = dict.fromkeys(FLAVORS.values(), 0)
    for name, path in packages.items():
        for flavor, title in FLAVORS.items():
            said = failed(path, flavor)
            clauses[title] += len(said)
            print(f"{name:12} {title:10} {', '.join(said) or 'passes'}", flush=True)
    for title, count in clauses.items():
        figure(f"clauses of {title} that a package fails, by veraPDF 1.28.2", count)
    return sum(clauses.values())


def tamperings(packages: dict[str, Path], given: Path) -> int:
    """Tamper with the packages in turn; return how often the command did not tell."""
    missed, names = 0, list(packages)
    for seed in range(COUNT):
        kind, name = KINDS[seed], names[seed % len(names)]
        given.write_bytes(kind(packages[name].read_bytes(), random.Random(seed)))
        code = verified(given)
        print(f"{seed:4} {name:12} {kind.__name__}: exit code {code}", flush=True)
        # What is drawn otherwise is not compared, and this is said.
        missed += code not in (1, 4)
        given.with_name("given-again.pdf").unlink(missing_ok=True)
    figure("packages tampered with, each in a different way", COUNT)
    figure("tampered packages that verify", missed)
    return missed


def main() -> int:
    """Report each project, then check its package."""
    with tempfile.TemporaryDirectory() as out:
        packages, wrong = {}, 0
        for name in PROJECTS[: 1 if SMOKE else None]:
            words = ("report", str(ROOT / "projects" / name), "--out", f"{out}/{name}", "--quiet")
            finished(command(*words))
            packages[name] = Path(out) / name / "calc-package.pdf"
            wrong += verified(packages[name]) != 0
        figure("packages", len(packages))
        figure("packages that do not verify as written", wrong)
        if not SMOKE and shutil.which("mvn") and shutil.which("java"):
            wrong += standards(packages)
        return 1 if wrong + tamperings(packages, Path(out) / "given.pdf") else 0


if __name__ == "__main__":
    sys.exit(main())
