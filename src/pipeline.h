#pragma once

#include "base/log.h"
#include "base/options.h"
#include "label/alpha_shape.h"
#include "label/cut.h"
#include "model/scene.h"
#include "model/tri_mesh.h"
#include "points/filter.h"
#include "sight/trace.h"
#include "sight/virtual_views.h"
#include "surface/cleanup.h"
#include "surface/needles.h"
#include "surface/sheets.h"
#include "surface/simplify.h"
#include "surface/smooth.h"
#include "surface/support.h"
#include "surface/webs.h"

#include <array>
#include <cstdint>

namespace vcarve {

/// How cells are told outside from inside.
enum class Method { cut, strict, alpha, sculpt };

/// Whether the method knows the points only: then no view says which faces to keep.
constexpr bool ignores_views(Method method)
{
    return method == Method::alpha || method == Method::sculpt;
}

/// Everything a run can be told, stage by stage.
struct Options {
    Method method = Method::cut;
    int min_crossings = 1;
    AlphaOptions alpha;
    bool closed = false;
    int threads = 0;
    std::int64_t max_memory = 0; ///< bytes
    FilterOptions filter;
    TraceOptions trace;
    VirtualViewOptions virtual_views;
    CutOptions cut;
    WebOptions webs;
    NeedleOptions needles;
    SupportOptions support;
    SheetOptions sheets;
    CleanupOptions cleanup;
    SmoothOptions smooth;
    SimplifyOptions simplify;

    void visit(OptionVisitor& options)
    {
        static constexpr std::array<const char*, 4> kMethods = {"cut", "strict", "alpha", "sculpt"};
        options.stage("Method");
        options.choice(
            method, kMethods,
            {.name = "method",
             .help = "cut: the labelling that contradicts the sights least. strict: every cell "
                     "a sight crosses is outside (for points without noise). alpha, sculpt: alpha "
                     "shape and Boissonnat's sculpture, to compare with; they know the points "
                     "only, and all their faces are kept as with --closed."});
        options.count(min_crossings,
                      {.name = "min-crossings",
                       .unit = "sights",
                       .help = "With --method strict: how many sights must cross a facet "
                               "to carve the cells beside it.",
                       .min = 1});
        alpha.visit(options);
        filter.visit(options);
        trace.visit(options);
        cut.visit(options);
        webs.visit(options);
        needles.visit(options);
        virtual_views.visit(options);
        options.stage("Surface");
        options.flag(closed,
                     {.name = "closed",
                      .help = "Keep faces that no view supports, so that the surface is closed."});
        support.visit(options);
        sheets.visit(options);
        cleanup.visit(options);
        smooth.visit(options);
        simplify.visit(options);
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

/// A surface and the scene it was made from: the points that passed the filter, in the order
/// TriMesh::points counts them, centred.
struct Reconstruction {
    Scene scene;
    TriMesh mesh;
};

/// From a scene to its surface: the passes in order, on `options.threads` threads; the result does
/// not depend on how many. Throws InputError where the scene holds too little for a surface, and
/// before any work where it would need more than `options.max_memory`.
Reconstruction reconstruct(Scene input, const Options& options, Log& log);

} // namespace vcarve
