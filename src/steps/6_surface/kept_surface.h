#pragma once

#include "io/work/kept_fields.h"
#include "mesh/removed_faces.h"
#include "steps/6_surface/make_surface.h"

namespace vcarve {

template <>
struct KeptFields<ViewLine> {
    static void visit(const auto& field, auto& line)
    {
        field(line.eye);
        field(line.end);
    }
};

template <>
struct KeptFields<Openness> {
    static void visit(const auto& field, auto& openness)
    {
        field(openness.rays);
        field(openness.open);
    }
};

template <>
struct KeptFields<SeenSurface> {
    static void visit(const auto& field, auto& seen)
    {
        field(seen.faces);
        field(seen.openness);
    }
};

template <>
struct KeptFields<RemovedFaces> {
    static void visit(const auto& field, auto& removed)
    {
        field(removed.mesh);
        field(removed.reasons);
    }
};

/// What a stage file of a surface holds: also what was taken away, where somebody asked for it.
struct CarvedSurface {
    SeenSurface seen;
    RemovedFaces removed;
};

template <>
struct KeptFields<CarvedSurface> {
    static void visit(const auto& field, auto& carved)
    {
        field(carved.seen);
        field(carved.removed);
    }
};

} // namespace vcarve
