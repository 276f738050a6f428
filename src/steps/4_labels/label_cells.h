#pragma once

#include "base/log.h"
#include "base/options.h"
#include "model/labels.h"
#include "model/scene.h"
#include "model/tet_mesh.h"
#include "steps/3_visibility/trace.h"
#include "steps/3_visibility/virtual_views.h"
#include "steps/4_labels/bridging_facets.h"
#include "steps/4_labels/cut.h"
#include "steps/4_labels/needles.h"

#include <array>

namespace vcarve {

/// How cells are told outside from inside.
enum class Method { cut, strict };

/// Everything that decides which cells are inside.
struct LabelOptions {
    Method method = Method::cut;
    int min_crossings = 1;
    TraceOptions trace;
    CutOptions cut;
    BridgingOptions bridging;
    NeedleOptions needles;
    VirtualViewOptions virtual_views;

    void visit(OptionVisitor& options)
    {
        static constexpr std::array<const char*, 2> kMethods = {"cut", "strict"};
        options.stage("Method");
        options.choice(
            method, kMethods,
            {.name = "method",
             .help = "cut: the labelling that contradicts the sights least. strict: every cell "
                     "a sight crosses is outside (for points without noise)."});
        options.count(min_crossings,
                      {.name = "min-crossings",
                       .unit = "sights",
                       .help = "With --method strict: how many sights must cross a facet "
                               "to carve the cells beside it.",
                       .min = 1});
        trace.visit(options);
        cut.visit(options);
        bridging.visit(options);
        needles.visit(options);
        virtual_views.visit(options);
    }
};

/// Labels each cell outside or inside by the sights of the scene. With virtual viewpoints, the
/// cells are labelled once by the real sights, viewpoints are placed in the space that is then
/// known to be free, and the cells are labelled again with the sights of both. The labels do not
/// depend on the number of threads. Cost: a walk for each sight, and that of the labelling (see
/// strict_carving.h, cut.h, bridging_facets.h and needles.h).
Labels label_cells(const TetMesh& cells, const Scene& scene, const LabelOptions& options, Log& log);

} // namespace vcarve
