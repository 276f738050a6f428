#pragma once

#include "base/options.h"
#include "model/scene.h"
#include "model/tri_mesh.h"

namespace vcarve {

struct SupportOptions {
    double max_edge = 8.0;
    double max_gap_edge = 1.6;

    void visit(OptionVisitor& options)
    {
        options.number(max_edge,
                       {.name = "max-edge",
                        .unit = "x local edge",
                        .help = "Drop faces with an edge this many times longer than the median "
                                "around them; 0 drops none for their size."});
        options.number(max_gap_edge,
                       {.name = "max-gap-edge",
                        .unit = "x local edge",
                        .help = "Keep a few unseen faces amid seen ones if no edge is this many "
                                "times longer than the median around; 0 keeps none."});
    }
};

/// The faces that evidence supports: each corner was seen from the front of the face by some view
/// of its point's track, or the face is one of a few small ones amid such faces; and no edge is
/// much longer than those around. The rest (the shell behind walls and under floors, webs across
/// free space) is dropped; vertices are kept. Needs TriMesh::points. Cost: O(faces + sights),
/// mostly in parallel.
TriMesh keep_supported(TriMesh mesh, const Scene& scene, const SupportOptions& options);

} // namespace vcarve
