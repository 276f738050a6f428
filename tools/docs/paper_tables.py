"""The tables of docs/paper.md, and the power laws of times."""
import sys

from paper_drawing import fitted

PAPERS_POINTS = 29
VIEWPOINTS = (7, 10, 15, 23)
LAW_FROM_POINTS = 1000  # below, constant costs are visible

# Key in measured.json -> its name in table 1 of the paper, and the paper's seconds for VIEWPOINTS:
# 29 points, an SGI O2 at 200 MHz.
OPERATIONS = {
    "delaunay": ("Delaunay triangulation", (.641, .641, .641, .641)),
    "check": ("check for redundant triangles", (.5, .635, .79, 1.1)),
    "tetrahedra": ("removal of redundant tetrahedra", (.0719, .072, .083, .08)),
    "hidden": ("removal of hidden triangles", (.05, .057, .055, .062)),
    "normals": ("correcting face normals", (.1, .11, .12, .12)),
}
PAPERS_SHARES = ("39 %", "45 %", "4.8 %", "3.4 %", "7.8 %")  # as printed


def rows_at(kept, points):
    return [row for row in kept["times"] if row["points"] == points]


def sizes_of(kept):
    return sorted({row["points"] for row in kept["times"]})


def seconds_of(row, operation):
    return row["seconds"][operation]["median"]


def by_viewpoints(kept, points, operation):
    return [(row["viewpoints"], seconds_of(row, operation)) for row in rows_at(kept, points)]


def by_points(kept, operation):
    return [(points, seconds_of(rows_at(kept, points)[-1], operation))
            for points in sizes_of(kept)]


def exponents_of(kept):
    """Operation -> exponents of viewpoints (in the paper, at the paper's number of points, at the
    largest number) and of points."""
    most = sizes_of(kept)[-1]
    return {name: (fitted(list(zip(VIEWPOINTS, papers)))[1],
                   fitted(by_viewpoints(kept, PAPERS_POINTS, name))[1],
                   fitted(by_viewpoints(kept, most, name))[1],
                   fitted([p for p in by_points(kept, name) if p[0] >= LAW_FROM_POINTS])[1])
            for name, (_, papers) in OPERATIONS.items()}


def series_of(kept):
    """The plots: title, axis, ticks, and the points of each operation with the start of its law."""
    viewpoints = [(v, str(v)) for v in VIEWPOINTS]
    sizes = [(n, f"{n:,}") for n in sizes_of(kept)]
    return [
        (f"the paper: {PAPERS_POINTS} points, 200 MHz", "viewpoints", viewpoints,
         [(list(zip(VIEWPOINTS, papers)), 0) for _, papers in OPERATIONS.values()]),
        (f"ours: {PAPERS_POINTS} points, one thread", "viewpoints", viewpoints,
         [(by_viewpoints(kept, PAPERS_POINTS, name), 0) for name in OPERATIONS]),
        (f"ours: {VIEWPOINTS[-1]} viewpoints, one thread", "points", sizes,
         [(by_points(kept, name), LAW_FROM_POINTS) for name in OPERATIONS])]


# ---- tables -------------------------------------------------------------------------------------

def markdown(head, rows, left_columns=1):
    return "\n".join(["| " + " | ".join(head) + " |",
                      "|" + "---|" * left_columns + "---:|" * (len(head) - left_columns)] +
                     ["| " + " | ".join(row) + " |" for row in rows])


def three_digits(value):
    return f"{value:.3g}" if value < 1000 else f"{value:,.0f}"


def percent(share):
    return f"{100 * share:.2g} %" if share < 0.1 else f"{100 * share:.0f} %"


def duration(seconds):
    for name, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)):
        if seconds >= size:
            break
    return f"{three_digits(seconds / size)} {name}"


def share_of(name, columns):
    """The share of an operation in the time of all, over all columns."""
    return sum(columns[name]) / sum(sum(column) for column in columns.values())


def table_beside_paper(kept):
    ours = {name: [1e6 * y for _, y in by_viewpoints(kept, PAPERS_POINTS, name)]
            for name in OPERATIONS}
    papers = {name: seconds for name, (_, seconds) in OPERATIONS.items()}
    head = ["operation", *(f"paper: {v}, s" for v in VIEWPOINTS), "share",
            *(f"ours: {v}, µs" for v in VIEWPOINTS), "share"]
    rows = [[title, *(f"{s:g}" for s in seconds), papers_share,
             *(three_digits(s) for s in ours[name]), percent(share_of(name, ours))]
            for (name, (title, seconds)), papers_share in zip(OPERATIONS.items(), PAPERS_SHARES)]
    rows.append(["all five", *(three_digits(sum(c)) for c in zip(*papers.values())), "",
                 *(three_digits(sum(c)) for c in zip(*ours.values())), ""])
    rows.append(["rays"] + [""] * 5 +
                [f"{row['rays']:,}" for row in rows_at(kept, PAPERS_POINTS)] + [""])
    return markdown(head, rows)


def table_of_sizes(kept):
    rows = []
    for points in sizes_of(kept):
        row = rows_at(kept, points)[-1]
        every = {name: [seconds_of(row, name)] for name in OPERATIONS}
        rows.append([f"{points:,}", f"{row['rays']:,}",
                     *(f"{duration(every[name][0])}, {percent(share_of(name, every))}"
                       for name in OPERATIONS)])
    return markdown(["points", "rays", *(title for title, _ in OPERATIONS.values())], rows, 0)


def table_of_laws(kept):
    most = sizes_of(kept)[-1]
    head = ["operation", "paper: viewpoints", f"ours, {PAPERS_POINTS} points: viewpoints",
            f"ours, {most:,} points: viewpoints", "ours: points"]
    return markdown(head, [[OPERATIONS[name][0], *(f"{e:.2f}" for e in exponents)]
                           for name, exponents in exponents_of(kept).items()])


def table_of_scenes(rows):
    figures = ("F 0.25 %", "seen right", "blocked")
    head = ["scene", *(f"{method}: {name.removesuffix(' 0.25 %')}"
                       for method in ("strict", "cut") for name in figures)]
    return markdown(head, [[row["scene"], *(f"{row[method][name]:.3f}"
                                            for method in ("strict", "cut") for name in figures)]
                           for row in rows])


def require_claims(kept):
    """Checks the statements of the text about table 1."""
    exponents = exponents_of(kept)
    most = sizes_of(kept)[-1]
    still = max(abs(exponents[name][column]) for name in ("delaunay", "tetrahedra", "hidden")
                for column in (1, 2))
    claims = {
        "the check grows with the viewpoints, more than in the paper, and most of all":
            all(exponents["check"][0] < exponents["check"][column] < 1.25 and
                exponents["check"][column] == max(e[column] for e in exponents.values())
                for column in (1, 2)),
        "triangulation and removals hardly grow": still < 0.25,
        "the normals grow, but less": all(
            0.15 < exponents["normals"][column] < 0.8 for column in (1, 2)),
        "each grows about as the points": all(0.8 < e[3] < 1.4 for e in exponents.values()),
        "the triangulation takes most": all(
            seconds_of(row, "delaunay") == max(seconds_of(row, name) for name in OPERATIONS)
            for row in rows_at(kept, PAPERS_POINTS) + rows_at(kept, most)),
        "strict is worse on every scene": all(
            row["strict"]["F 0.25 %"] < row["cut"]["F 0.25 %"] and
            row["strict"]["seen right"] < row["cut"]["seen right"] and
            row["strict"]["blocked"] > row["cut"]["blocked"]
            for row in kept["fixtures"] + kept.get("scenes", []))}
    wrong = [claim for claim, holds in claims.items() if not holds]
    if wrong:
        sys.exit(f"paper: no longer true: {'; '.join(wrong)}. Correct tools/docs/paper_text.md "
                 "and paper_tables.py.")


def tables_of(kept):
    """Name in the text -> table or number."""
    require_claims(kept)
    exponents = exponents_of(kept)
    small = rows_at(kept, PAPERS_POINTS)[-1]
    most = rows_at(kept, sizes_of(kept)[-1])[-1]
    return {
        "table1": table_beside_paper(kept), "sizes": table_of_sizes(kept),
        "laws": table_of_laws(kept),
        "scenes": table_of_scenes(kept["fixtures"] + kept.get("scenes", [])),
        "machine": kept["machine"], "most_points": f"{most['points']:,}",
        "least_runs": f"{min(s['runs'] for r in kept['times'] for s in r['seconds'].values()):,}",
        "most_runs": f"{max(s['runs'] for r in kept['times'] for s in r['seconds'].values()):,}",
        "paper_check": f"{exponents['check'][0]:.2f}",
        "our_check": f"{exponents['check'][1]:.2f}",
        "our_normals": f"{exponents['normals'][1]:.2f}",
        "ray_small": duration(seconds_of(small, "check") / small["rays"]),
        "ray_most": duration(seconds_of(most, "check") / most["rays"]),
    }
