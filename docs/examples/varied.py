# %% [markdown]
# # An input varied in Python
#
# A workbook is read once. Its friction coefficients are then varied, and each variation is assessed
# as a workbook with these coefficients would be.

# %%
from pathlib import Path

import pandas as pd

import roofslip

workbook = roofslip.read_project(Path(roofslip.__file__).parent / "projects/conditions")
print(roofslip.__version__, [(array.id, array.mu) for array in workbook.project.arrays])

# %%
rows = []
for factor in (0.8, 0.9, 1.0):
    arrays = [
        array.model_copy(update={"mu": round(factor * array.mu, 3)})
        for array in workbook.project.arrays
    ]
    assessment = roofslip.assess_project(workbook.with_(arrays=arrays))
    rows += [
        {
            "factor": factor,
            "array": item.id,
            "prd_mm": 1e3 * max(run.result.prd_m for run in item.runs),
        }
        for item in assessment.arrays
    ]
table = pd.DataFrame(rows).pivot(index="factor", columns="array", values="prd_mm")
print(table.round(0))

# %%
axes = table.plot.bar(title="Largest PRD [mm] by the factor on friction", rot=0)
axes.figure.savefig("varied.png")

# %% [markdown]
# What a workbook may not have, a variation may not have either.

# %%
try:
    workbook.with_(arrays=[array.model_copy(update={"mu": -0.4}) for array in arrays])
except roofslip.InputError as error:
    print(error)
