"""One-dimensional compression: closed form, and exact on the lattice."""

G = 9.81
SAND = {"E": 60e6, "nu": 0.25, "rho": 2000.0, "height": 4.0}
CLAY = {"E": 20e6, "nu": 0.40, "rho": 1800.0, "height": 6.0}
AREA = 16.0  # [m^2]


def oedometer(soil):
    """M = lambda + 2 mu, vertical stress over strain without lateral strain [Pa]."""
    return soil["E"] * (1 - soil["nu"]) / ((1 + soil["nu"]) * (1 - 2 * soil["nu"]))


def at_rest(soil):
    """K0, lateral over vertical stress without lateral strain."""
    return soil["nu"] / (1 - soil["nu"])


def values(run):
    result = run()
    weight = {name: soil["rho"] * G * soil["height"] for name, soil in (("sand", SAND), ("clay", CLAY))}  # [Pa]
    # Each layer is pressed by half its own weight and by all that lies on it.
    settlement = (weight["sand"] / 2 / oedometer(SAND) * SAND["height"] +
                  (weight["sand"] + weight["clay"] / 2) / oedometer(CLAY) * CLAY["height"])
    yield "settlement of the surface [mm]", 1e3 * settlement, -1e3 * result.probe("surface.displacement.z"), 1e-6
    yield "force on the base [MN]", 1e-6 * AREA * sum(weight.values()), 1e-6 * result.probe("base.reaction.z"), 1e-6
    for name, soil, vertical in (("sand", SAND, weight["sand"] / 2), ("clay", CLAY, weight["sand"] + weight["clay"] / 2)):
        yield f"vertical stress, middle of the {name} [kPa]", -1e-3 * vertical, 1e-3 * result.probe(f"{name}.stress.zz"), 1e-6
        yield f"lateral stress, middle of the {name} [kPa]", -1e-3 * at_rest(soil) * vertical, \
            1e-3 * result.probe(f"{name}.stress.xx"), 1e-6
