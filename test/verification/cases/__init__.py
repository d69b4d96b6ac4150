"""One module a case. Each has:

TITLE, SOURCE, REMARKS   for docs/verification.md; the module's and the scene's comments say the rest
runs(full)               the runs it wants: coarse ones for the test, those of the published resolution for the page
quantities(results, full)   its figures beside their references, from results by the key of their run
convergence(results)     (optional) errors over cell size, from the results of the full runs
draw(results, path)      its picture, from the results of the full runs
"""

import importlib

# In the order of docs/verification.md: soil and integration, contact, geotextile, flow, water.
NAMES = ["oedometer", "self_weight_column", "compaction", "vibrating_bar", "axis_aligned", "vortex", "two_discs",
         "block_on_incline", "disc_on_incline", "rotating_plate", "two_walls", "capstan", "pressurised_cylinder",
         "stretched_string", "hanging_cable", "slack_ring", "fluid_tube", "fluid_column", "channel_flow", "bui_collapse",
         "granular_columns", "terminal_velocity", "hanging_container"]


def load(name):
    return importlib.import_module(f"cases.{name}")
