"""The contents of the pictures of docs/paper.md. paper_drawing draws them from the data of
tools/lab/make_paper_figures."""
import paper_tables
from paper_drawing import (PLOT_PX, SERIES, Eye, Plot, fitted, legend, picture,
                           row_of_panels)

# The eye of each object; the carved parts must be visible.
EYES = {"cube_with_cavity": Eye(-60, 55), "boissonnat": Eye(-70, 30), "cubicles": Eye(-60, 45),
        "desk": Eye(-65, 25)}


def tetrahedra(count):
    return f"{count:,} tetrahedr{'on' if count == 1 else 'a'}"


def hull_panel(figure):
    return {"wires": True, "layers": [figure["delaunay"]],
            "caption": ["Delaunay triangulation",
                        f"{figure['points']:,} points, {tetrahedra(figure['cells'])}"]}


def recovered(figure):
    return [hull_panel(figure),
            {"layers": [figure["strict"]],
             "caption": [f"{figure['views']} viewpoints",
                         f"{figure['faces']} triangles: the true solid" if figure["exact"] else
                         f"{figure['faces']} triangles, not the true solid"]}]


def in_states(figure):
    panels = [hull_panel(figure)]
    for state in figure["states"]:
        panels.append({"layers": [state["panel"]],
                       "caption": [f"{state['views']} viewpoints",
                                   "the true solid" if state["exact"] else
                                   f"{tetrahedra(state['left'])} left in empty space (red)"]})
    return panels


def alpha_shapes(figure):
    heads = {"nothing_kept": "the largest that fills no empty space",
             "fewest": "fewest tetrahedra wrong",
             "whole": "the smallest with all points, in one piece",
             "nothing_lost": "the smallest that has all of the solid"}
    return [{"layers": [figure[name]["panel"]],
             "caption": [f"alpha {figure[name]['alpha']:.3g}", head,
                         f"lost {figure[name]['lost']}, wrongly kept {figure[name]['kept']}"]}
            for name, head in heads.items()]


def sculpted(figure):
    return [{"layers": [figure["start"]],
             "caption": ["the convex hull", "red: the tetrahedron that is taken first,",
                         "part of the solid" if figure["first_is_solid"] else "not of the solid"]},
            {"layers": [figure["panel"]],
             "caption": ["all points on the boundary",
                         f"{figure['lost']} of {tetrahedra(figure['solid_cells'])} of the solid lost,",
                         f"{figure['kept']} of {figure['empty_cells']} of empty space kept"]},
            {"layers": [figure["truth"]], "caption": ["the true solid", "as carving gives it"]}]


def unmet(figure):
    views = f"{figure['views']} viewpoints"
    return [{"layers": [figure["triangles"]],
             "caption": [f"{views}: triangles removed",
                         f"yellow: {figure['unmet']} that no virtual line meets"]},
            {"layers": [figure["tetrahedra"]],
             "caption": [f"{views}: tetrahedra removed", "the true solid"]},
            {"layers": [figure["pair"]], "rays": sum(figure["pair_rays"], []), "reach": 2.2,
             "fit": figure["pair"],
             "caption": ["one of the triangles, and its tetrahedra",
                         f"virtual lines cross these: {len(figure['pair_rays'][0])} the one, "
                         f"{len(figure['pair_rays'][1])} the other"]}]


def artificial(figure):
    return [{"layers": [figure["before"]],
             "caption": ["2 viewpoints",
                         f"{tetrahedra(figure['left'])} left in the cavity (red)"]},
            {"layers": [figure["after"]],
             "caption": [f"2 viewpoints and {figure['virtual_views']} artificial ones",
                         "the true solid" if figure["still_left"] == 0 else
                         f"{figure['still_left']} left"]}]


def drilled(figure):
    def verdict(made):
        if made["lost"] == 0 and made["kept"] == 0:
            return "the true solid"
        return f"{tetrahedra(made['lost'])} of the solid lost (red)"

    seen_through = [facet[:3] + ["hull"] + facet[4:] for facet in figure["truth"]]
    return [{"layers": [seen_through], "rays": [figure["line"]], "reach": 7.0,
             "caption": [f"{figure['rays']} right rays and a wrong one",
                         "(red), of a point behind the block"]},
            {"layers": [figure["strict"]["panel"]],
             "caption": ["--method strict", verdict(figure["strict"])]},
            {"layers": [figure["cut"]["panel"]],
             "caption": ["--method cut", verdict(figure["cut"])]}]


def laws(kept):
    """Plots table 1 of the paper and ours over the viewpoints, and ours over the points."""
    panels = paper_tables.series_of(kept)
    parts = []
    for i, (title, below, across, series) in enumerate(panels):
        values = [y for points, _ in series for _, y in points]
        plot = Plot(i * PLOT_PX[0], title, across, values)
        for color, (points, fitted_from) in zip(SERIES, series):
            plot.line(points, fitted([p for p in points if p[0] >= fitted_from]), color)
        plot.below(below)
        parts += plot.parts
    parts += legend([name for name, _ in paper_tables.OPERATIONS.values()], PLOT_PX[1] + 12)
    return picture(len(panels) * PLOT_PX[0], PLOT_PX[1] + 26, parts)


def pictures_of(figures, kept):
    """Name -> SVG."""
    shown = {"figure1": sculpted, "figure2": alpha_shapes, "figure3": alpha_shapes,
             "figure13": unmet, "figure15": recovered, "figure16": recovered,
             "figure17": in_states, "figure18": recovered, "virtual": artificial,
             "drilled": drilled}
    made = {}
    for name, panels_of in shown.items():
        figure = figures[name]
        made[name] = row_of_panels(figures["sceneries"][figure["object"]], EYES[figure["object"]],
                                   panels_of(figure))
    made["table1"] = laws(kept)
    return made
