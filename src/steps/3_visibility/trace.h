#pragma once

#include "base/log.h"
#include "base/options.h"
#include "model/scene.h"
#include "model/tet_mesh.h"
#include "model/virtual_sights.h"
#include "model/visibility_energy.h"

namespace vcarve {

/// How much a sight says, and how far behind its point.
struct TraceOptions {
    double views_sigma = 1.5;
    double distance_sigma = 0.5;
    double sink_depth = 0.0;
    double error_sigma = 3.0;

    void visit(OptionVisitor& options)
    {
        options.stage("Sights");
        options.number(
            views_sigma,
            {.name = "views-sigma",
             .unit = "views",
             .help = "A sight weighs 1 - exp(-n^2 / 2 s^2) for a point of n views, relative to the "
                     "median point; 0 gives every sight the same weight.",
             .max = 100.0});
        options.number(
            error_sigma,
            {.name = "error-sigma",
             .unit = "x median error",
             .help =
                 "A sight weighs exp(-(e^2 - 1) / 2 s^2) of that for a point whose reprojection "
                 "error is e > 1 medians; 0 takes no account of errors.",
             .max = 1000.0});
        options.number(distance_sigma,
                       {.name = "distance-sigma",
                        .unit = "x short edge",
                        .help = "Uncertainty of a point along its sights, as a multiple of the "
                                "25th percentile of edge lengths; 0 trusts every point fully.",
                        .max = 1000.0});
        options.number(sink_depth,
                       {.name = "sink-depth",
                        .unit = "x distance sigma",
                        .help = "How far behind a point its sights call the space inside; "
                                "0 means the cell that begins at the point.",
                        .max = 1000.0});
    }
};

/// How many sights cross each facet (Akgunduz, Zetu, Banerjee 2000, section 4.2).
/// Cost: one walk a sight, in parallel; 16 bytes a cell.
Crossings count_crossings(const TetMesh& cells, const Scene& scene, Stage& stage);

/// Adds virtual sights, each `weight` of a real one, rounded down facet by facet.
void add_crossings(const TetMesh& cells, const VirtualSights& sights, double weight,
                   Crossings& crossings, Stage& stage);

/// Each sight asks for the cells before its point to be outside and for the cell behind it to be
/// inside (Labatut, Pons, Keriven 2009), softly near the point. The terms are integers, so their
/// sums do not depend on the number of threads. Each sight's own flow is pushed along its walk at
/// once, which leaves the minimum cut as it is (algorithm: docs/algorithm.md). Where a sight meets
/// an edge or a vertex no facet leads its flow on: each stretch between such places ends in a
/// source (behind the point a sink) of its own, as strong as the term of the sight for what comes
/// next. Throws InputError if a sum leaves 32 bits. Cost: one walk a sight, in parallel; 20 bytes a
/// cell.
VisibilityEnergy trace_sights(const TetMesh& cells, const Scene& scene, const TraceOptions& options,
                              Stage& stage);

/// Adds the terms of virtual sights, each `weight` times that of a real sight of its point. They
/// speak for outside only, because the real sights know more of what lies behind a point.
void add_sights(const TetMesh& cells, const Scene& scene, const VirtualSights& sights,
                double weight, const TraceOptions& options, VisibilityEnergy& energy, Stage& stage);

} // namespace vcarve
