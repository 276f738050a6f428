#include "steps/7_refine/refine.h"

#include <fmt/format.h>

namespace vcarve {

namespace {

SightGuard guard_sights(const HalfEdgeMesh& mesh, const Scene& scene, Log& log)
{
    Stage stage(log, "guard");
    SightGuard guard(scene, mesh, stage);
    stage.end({{"free sights", guard.num_free()}, {"of", guard.num_sights()}});
    return guard;
}

void smooth(HalfEdgeMesh& mesh, const SightGuard& guard, const SmoothOptions& options, Log& log)
{
    Stage stage(log, "smooth");
    const SmoothCounts counts = smooth_surface(mesh, guard, options, stage);
    stage.end({{"vertices moved", counts.moved},
               {"of", counts.vertices},
               {"held by sights", counts.held}});
}

void simplify(HalfEdgeMesh& mesh, const SightGuard& guard, const SimplifyOptions& options, Log& log)
{
    Stage stage(log, "simplify");
    const SimplifyCounts counts = simplify_surface(mesh, guard, options, stage);
    stage.end({{"faces", counts.faces}, {"of", counts.faces_before}});
    if (counts.faces > options.faces) {
        log.note(fmt::format("{} faces are left, not {}: merging more vertices would hide what was "
                             "seen, or fold or tear the surface",
                             counts.faces, options.faces));
    }
}

} // namespace

void refine(HalfEdgeMesh& mesh, const Scene& scene, const RefineOptions& options, Log& log)
{
    const bool smooths = options.smooth.iterations > 0;
    const bool simplifies = options.simplify.faces > 0;
    if (!smooths && !simplifies) return;
    const SightGuard guard = guard_sights(mesh, scene, log);
    if (smooths) smooth(mesh, guard, options.smooth, log);
    if (simplifies) simplify(mesh, guard, options.simplify, log);
}

} // namespace vcarve
