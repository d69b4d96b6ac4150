"""The discretisations that the cases compare, as overrides of a scene."""

DEFAULT = {}
FLIP = {"numerics.transfer": "flip"}
GIMP = {"numerics.shape": "gimp"}
# The founding paper's: three-node triangles, standard MPM (Sulsky, Chen and Schreyer 1994), lumped mass, velocities
# mapped back from the particles (Sulsky, Zhou and Schreyer 1995). Particles that cross from one element to the next
# make energy, which the run is not to be stopped for here.
STANDARD = {"numerics.shape": "linear_simplex", "numerics.transfer": "flip", "numerics.update": "musl",
            "numerics.energy_jump": 1.0}
# Its remedy against the error of partly filled and crossed elements (Beuth, Wieckowski and Vermeer 2011).
CELL_AVERAGE = {**STANDARD, "numerics.smoothing": "cell_average"}
NODAL_MIXED = {**STANDARD, "numerics.smoothing": "nodal_mixed"}

# For script/bench work-precision, by the name that its table uses.
SWEEP = {
    "bspline2 apic": {"numerics.shape": "bspline2", "numerics.transfer": "apic"},
    "bspline2 apic musl": {"numerics.shape": "bspline2", "numerics.transfer": "apic", "numerics.update": "musl"},
    "bspline2 flip": {"numerics.shape": "bspline2", "numerics.transfer": "flip"},
    "bspline2 flip 0.99": {"numerics.shape": "bspline2", "numerics.transfer": "flip", "numerics.flip_fraction": 0.99},
    "gimp apic": GIMP,
    "linear flip": STANDARD,
    "linear flip cell_average": CELL_AVERAGE,
    "linear flip nodal_mixed": NODAL_MIXED,
}
# Consistent mass costs a linear solve a step: swept on two cases only.
CONSISTENT = {
    "bspline2 flip consistent": {**FLIP, "numerics.mass": "consistent"},
    "linear flip consistent": {**STANDARD, "numerics.mass": "consistent"},
}
