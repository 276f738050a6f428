#pragma once

#include "base/log.h"
#include "base/options.h"
#include "model/scene.h"
#include "steps/6_refine/simplify.h"
#include "steps/6_refine/smooth.h"

namespace vcarve {

/// How vertices are moved and merged; by default neither is done.
struct RefineOptions {
    SmoothOptions smooth;
    SimplifyOptions simplify;

    void visit(OptionVisitor& options)
    {
        smooth.visit(options);
        simplify.visit(options);
    }
};

/// Moves vertices (smooth.h), then merges them (simplify.h), each where it is asked for. Neither
/// makes a face hide a point from a view that it did not hide before (sight_guard.h). The vertices
/// must know their points of the scene.
void refine(HalfEdgeMesh& mesh, const Scene& scene, const RefineOptions& options, Log& log);

} // namespace vcarve
