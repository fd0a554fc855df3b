"""Effect of each part of the methods ``best`` and ``paper``, on synthetic recordings.

    python benchmarks/ablations.py

The presets ``people`` and ``hands``, with one part changed at a time. One thread per process.
"""

from __future__ import annotations

from _suite import HEADER, last_line, row, tracked

TERMS = ("visibility", "free_space", "intersection", "continuity")


def without(term: str) -> str:
    """Returns the setting that omits one term."""
    return f"methods.method.terms=[{', '.join(other for other in TERMS if other != term)}]"


ROWS: dict[str, tuple[str, ...]] = {
    "best": (),
    "frozen covariance": ("methods.method.kernel.covariance=frozen",),
    "volume": ("methods.method.shape.surface=volume",),
    "correlation": ("methods.method.kernel=correlation",),
    "SoG": ("methods.method.shape={kind: sog, surface: visible}",),
    **{f"without {term}": (without(term),) for term in TERMS},
    "without any term": ("methods.method.terms=[]",),
    "without recovery": ("methods.method.tracker.recovery=null",),
    "tracker constant_pose": ("methods.method.tracker={kind: constant_pose}",),
    "4 iterations": ("methods.method.solver.max_iterations=4",),
    "10 iterations": ("methods.method.solver.max_iterations=10",),
    "L-BFGS": ("methods.method.solver={kind: lbfgs}",),
    **{
        f"octree leaf {leaf:g} cm": (f"preprocessor={{kind: octree, leaf: {leaf / 100:g}}}",)
        for leaf in (3.0, 4.5, 6.0, 9.0)
    },
}

PAPER = {
    "paper, SoG": "{preset: paper, shape: sog}",
    "paper, G-SoG": "{preset: paper}",
    "paper, SoG, exact covariance": "{preset: paper, shape: sog, kernel: {covariance: exact}}",
    "paper, G-SoG, exact covariance": "{preset: paper, kernel: {covariance: exact}}",
    "paper, SoG, visible, exact": (
        "{preset: paper, shape: {kind: sog, surface: visible}, kernel: {covariance: exact}}"
    ),
    "paper, G-SoG, visible, exact": (
        "{preset: paper, shape: {surface: visible}, kernel: {covariance: exact}}"
    ),
    "paper, SoG, clamp": (
        "{preset: paper, shape: sog, terms: [visibility, intersection, continuity, clamp]}"
    ),
    "paper, G-SoG, clamp": (
        "{preset: paper, terms: [visibility, intersection, continuity, "
        "{kind: clamp, covariance: frozen}]}"
    ),
}


def main() -> None:
    """Prints the tables, and their figures as one JSON object in the last line."""
    print(HEADER)
    figures = {
        name: row(name, tracked("human", "{preset: best}", settings))
        for name, settings in ROWS.items()
    }
    print(f"\n{HEADER}")
    figures |= {name: row(name, tracked("human", method)) for name, method in PAPER.items()}
    print(f"\n{HEADER.replace('method', 'hands')}")
    hands = ("best", *(name for name in ROWS if name.startswith("without")))
    figures |= {
        f"hands, {name}": row(name, tracked("hand", "{preset: best}", ROWS[name])) for name in hands
    }
    last_line(figures)


if __name__ == "__main__":
    main()
