#pragma once

#include "base/options.h"
#include "steps/1_points/filter.h"
#include "steps/4_labels/label_cells.h"
#include "steps/5_surface/make_surface.h"
#include "steps/6_refine/refine.h"

#include <cstdint>

namespace vcarve {

/// Everything a run can be told, step by step.
struct Options {
    FilterOptions points;
    LabelOptions labels;
    SurfaceOptions surface;
    RefineOptions refine;
    int threads = 0;
    std::int64_t max_memory = 0; ///< bytes

    void visit(OptionVisitor& options)
    {
        points.visit(options);
        labels.visit(options);
        surface.visit(options);
        refine.visit(options);
        options.stage("Run");
        options.count(threads,
                      {.name = "threads",
                       .unit = "threads",
                       .help = "How many to use; 0 uses all. The surface is the same for any.",
                       .max = 1024});
        options.bytes(max_memory,
                      {.name = "max-memory",
                       .help = "Refuse a model that is likely to need more memory, judging by its "
                               "points and sights, before work starts: bytes, or with K, M or G; 0 "
                               "refuses none."});
    }
};

} // namespace vcarve
