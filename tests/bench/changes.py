"""How many files a change takes: five changes made on a scratch copy, tried, and counted.

Claim: a rule set, a column of the results and a requirement are one file of code each, a record
format and a page of the package are two. Each is made as a developer would make it, then used; the
files that differ from the checkout are counted.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import ROOT, SMOKE, figure


def replaced(path: Path, old: str, new: str) -> None:
    """Replace the one place where a text stands."""
    text = path.read_text(encoding="utf-8")
    if text.count(old) != 1:
        raise SystemExit(f"{path}: {text.count(old)} places of {old!r}")
    path.write_text(text.replace(old, new), encoding="utf-8")


def rule_set(top: Path) -> None:
    """Add an edition of ASCE 7 with the numbers of the last one."""
    path = top / "solver" / "rules" / "rulesets.py"
    text = path.read_text(encoding="utf-8")
    begin = text.rindex("        replace(\n")
    end = text.index("\n        ),\n", begin) + len("\n        ),\n")
    last = text[begin:end]
    added = last.replace("asce7-22", "asce7-28").replace("7-22", "7-28")
    path.write_text(text[:end] + added + text[end:], encoding="utf-8")


FORMAT = '''"""Records of one header line `%ACC dt`, then accelerations in g."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from solver.formats.channels import MotionFile
from solver.formats.source import Source
from solver.records.record import Record, UNITS


def recognizes(lines: Sequence[str]) -> bool:
    """Whether the lines are of such a file."""
    return lines[0].startswith("%ACC ")


def read(source: Source) -> MotionFile:
    """Return its channel."""
    a = np.array([float(line) for line in source.lines[1:]]) * UNITS["g"]
    a.setflags(write=False)
    record = Record(name="channel", dt_s=float(source.lines[0].split()[1]), a_mps2=a)
    return MotionFile(name=source.name, format="ACC", notes=(), channels=(record,))
'''


def record_format(top: Path) -> None:
    """Add a format of records."""
    (top / "solver" / "formats" / "acc.py").write_text(FORMAT, encoding="utf-8")
    reader = top / "solver" / "formats" / "reader.py"
    replaced(reader, "solver.formats import cosmos,", "solver.formats import acc, cosmos,")
    replaced(reader, " = (cosmos,", " = (acc, cosmos,")


PAGE = """<section>
{{ heading(part) }}
<p>Wind on {{ p.arrays | length }} arrays is not checked, see {{ ref("basis") }}.</p>
</section>
"""


def page(top: Path) -> None:
    """Add a page after the limits."""
    (top / "templates" / "wind.html").write_text(PAGE, encoding="utf-8")
    registry = top / "report" / "pages" / "registry.py"
    replaced(
        registry,
        '    Page("provisions",',
        '    Page("wind", "Wind", lambda *_: {}),\n    Page("provisions",',
    )


FIELD = """    motions_run: Annotated[
        int, at("analysis.n_motions"), words("Motions"), Column("Motions run"), Told()
    ]
"""


def column(top: Path) -> None:
    """Add a column to the results of arrays."""
    path = top / "report" / "entities" / "array.py"
    before = "    tipping: TippingResult\n"
    replaced(path, before, FIELD + before)


ROW = """def _storm(data: ProjectInput) -> Requirement:
    return Requirement(
        id="storm",
        title="Wind on the arrays",
        found=NOT_GIVEN,
        limit="checked by others",
        basis="practice",
        is_satisfied=False,
        consequence=Consequence.CONDITION,
        remedy="Have it checked.",
        place=Place("options", 0, "peer_reviewer"),
    )


"""


def requirement(top: Path) -> None:
    """Add a requirement on the project."""
    path = top / "report" / "assessment" / "conditions.py"
    replaced(
        path,
        "        *_peer_review(data),\n",
        "        *_peer_review(data),\n        _storm(data),\n",
    )
    before = "def _peer_review("
    replaced(path, before, ROW + before)


# What a change is, how it is made, and Python that fails where it does not work.
CHANGES = (
    (
        "rule set",
        rule_set,
        "from report.sheet.schema.choices import RuleSetName\n"
        "from solver.rules.rulesets import RULE_SETS\n"
        "assert RULE_SETS[RuleSetName('ASCE 7-28')].values['prescriptive_factor_in'].value == 60.0",
    ),
    (
        "record format",
        record_format,
        "from pathlib import Path\n"
        "import solver\n"
        "Path('x.acc').write_text('%ACC 0.01\\n0\\n0.5\\n0\\n')\n"
        "assert solver.read_record(Path('x.acc')).dt_s == 0.01\n"
        "Path('x.acc').unlink()",
    ),
    (
        "page",
        page,
        "import report\n"
        "from report.assessment.evidence import support\n"
        "from report.package.html import pages\n"
        "assessment = report.assess_project('projects/example')\n"
        "html = pages(assessment, support(assessment))\n"
        "assert 'Wind on 3 arrays is not checked, see part 3.' in html",
    ),
    (
        "column",
        column,
        "import json\n"
        "from io import BytesIO\n"
        "import report\n"
        "from openpyxl import load_workbook\n"
        "from report.assessment.evidence import support\n"
        "from report.entities.results import schema\n"
        "from report.results.results_json import results_json\n"
        "from report.results.xlsx import results_xlsx\n"
        "assessment = report.assess_project('projects/example')\n"
        "evidence = support(assessment)\n"
        "assert json.loads(results_json(assessment, evidence))['arrays'][0]['motions_run'] == 7\n"
        "assert 'motions_run' in schema()['$defs']['ArrayResult']['properties']\n"
        "sheet = load_workbook(BytesIO(results_xlsx(assessment, evidence.spectra)))['Design']\n"
        "assert any('Motions run' in row for row in sheet.iter_rows(values_only=True))",
    ),
    (
        "requirement",
        requirement,
        "import json\n"
        "import report\n"
        "from report.assessment.evidence import support\n"
        "from report.package.html import pages\n"
        "from report.pages.summary import attention\n"
        "from report.results.results_json import results_json\n"
        "assessment = report.assess_project('projects/example')\n"
        "evidence = support(assessment)\n"
        "rows = json.loads(results_json(assessment, evidence))['requirements']\n"
        "assert 'storm' in {row['id'] for row in rows}\n"
        "assert pages(assessment, evidence).count('Wind on the arrays') >= 2\n"
        "assert any('wind on the arrays' in line.text for line in attention(assessment))",
    ),
)


def git(top: Path, *words: str) -> str:
    """Run git in a folder."""
    done = subprocess.run(["git", *words], cwd=top, check=True, capture_output=True, text=True)
    return done.stdout


def main() -> None:
    """Print the files of each change."""
    with tempfile.TemporaryDirectory() as folder:
        top = Path(folder)
        for name in git(ROOT, "ls-files", "-z").split("\0"):
            if name and (ROOT / name).is_file():
                (top / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, top / name)
        git(top, "init", "-q")
        git(top, "add", "-A")
        git(top, "-c", "user.name=bench", "-c", "user.email=bench", "commit", "-qm", "as it is")
        for name, make, use in CHANGES:
            make(top)
            if not SMOKE:
                environment = os.environ | {"PYTHONPATH": str(top), "PYTHONDONTWRITEBYTECODE": "1"}
                used = [sys.executable, "-c", use]
                subprocess.run(used, cwd=top, env=environment, check=True)
            git(top, "add", "-A")
            changed = git(top, "diff", "--cached", "--name-only").split()
            print(name, *changed)
            figure(f"files of code that a {name} takes", len(changed))
            git(top, "reset", "-q", "--hard")


if __name__ == "__main__":
    main()
