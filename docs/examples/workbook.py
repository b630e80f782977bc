# %% [markdown]
# # A workbook assessed in Python
#
# The same assessment as `roofslip report`, without the package: each array, each clearance and
# each requirement is an object.

# %%
from pathlib import Path

import pandas as pd

import roofslip

assessment = roofslip.assess_project(Path(roofslip.__file__).parent / "projects/conditions")
print(assessment)

# %%
for array in assessment.arrays:
    print(array)

# %%
gaps = pd.DataFrame(
    {
        "from": check.clearance.array,
        "to": check.clearance.object,
        "required_m": check.required_m,
        "provided_m": check.clearance.provided_m,
        "verdict": check.verdict.value,
    }
    for check in assessment.clearances
)
print(gaps.round(3))

# %%
gaps.index = gaps["from"] + " to " + gaps["to"]
axes = gaps[["required_m", "provided_m"]].plot.barh(title="Clearances [m]")
axes.figure.set_layout_engine("tight")
axes.figure.savefig("clearances.png")

# %% [markdown]
# What is not satisfied, and what follows from it.

# %%
for row in assessment.open:
    print(f"{row.verdict.value}: {row.title}")

# %% [markdown]
# A gap is NG exactly where less than the required separation is provided.

# %%
is_short = gaps["provided_m"] < gaps["required_m"]
assert (is_short == (gaps["verdict"] == "NG")).all()
