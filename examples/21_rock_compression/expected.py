"""What random numbers must give, and what rocks do: they bear 8 to 24 times as much in compression as in tension."""
import math

MODULUS, SPACING, CORRELATION = 5, 2.0, 4.0  # [mm]
SECTION = 0.040**2  # [m^2]


def strength(result):
    """Largest stress on the platen [MPa]."""
    return 1e-6 * max(map(abs, result.history("press.reaction.z"))) / SECTION


def values(run):
    pressed = run()
    scatter = pressed.summary["scatter"]["rock"]["strength"]
    yield "variation of the strength, Weibull's", \
        math.sqrt(math.gamma(1 + 2 / MODULUS) / math.gamma(1 + 1 / MODULUS) ** 2 - 1), scatter["variation"], 0.05
    yield "correlation of neighbours", math.exp(-(SPACING / CORRELATION) ** 2), scatter["correlation"], 0.03
    pulled = run("boundary.top.displacement.z='0.05 mm'")
    yield "compressive over tensile strength of the body, 8 to 24", 16, strength(pressed) / strength(pulled), 0.5
    last = {name: pressed.history(name)[-1] for name in ("leapfrog energy", "damping", "cracks", "work of loads and supports")}
    yield "energy, damping and cracks [J], against the work of the platen", last["work of loads and supports"], \
        last["leapfrog energy"] + last["damping"] + last["cracks"], 1e-3
