#include "steps/6_refine/refine.h"

#include <fmt/format.h>

#include <utility>

namespace vcarve {

namespace {

SightGuard guard_sights(const TriMesh& mesh, const Scene& scene, Log& log)
{
    Stage stage(log, "guard");
    SightGuard guard(scene, mesh);
    stage.end({{"free sights", guard.num_free()}, {"of", guard.num_sights()}});
    return guard;
}

TriMesh smooth(const TriMesh& mesh, const SightGuard& guard, const RefineOptions& options, Log& log)
{
    Stage stage(log, "smooth");
    SmoothedSurface smoothed = smooth_surface(mesh, guard, options.smooth);
    stage.end({{"vertices moved", smoothed.counts.moved},
               {"of", size_of(mesh.positions.size())},
               {"held by sights", smoothed.counts.held}});
    return std::move(smoothed.mesh);
}

TriMesh simplify(const TriMesh& mesh, const SightGuard& guard, const RefineOptions& options,
                 Log& log)
{
    Stage stage(log, "simplify");
    TriMesh simple = simplify_surface(mesh, guard, options.simplify);
    stage.end({{"faces", size_of(simple.faces.size())}, {"of", size_of(mesh.faces.size())}});
    if (simple.faces.size() > static_cast<std::size_t>(options.simplify.faces)) {
        log.note(fmt::format("{} faces are left, not {}: merging more vertices would hide what was "
                             "seen, or fold or tear the surface",
                             simple.faces.size(), options.simplify.faces));
    }
    return simple;
}

} // namespace

TriMesh refine(TriMesh mesh, const Scene& scene, const RefineOptions& options, Log& log)
{
    const bool smooths = options.smooth.iterations > 0;
    const bool simplifies = options.simplify.faces > 0;
    if (!smooths && !simplifies) return mesh;
    const SightGuard guard = guard_sights(mesh, scene, log);
    if (smooths) mesh = smooth(mesh, guard, options, log);
    if (simplifies) mesh = simplify(mesh, guard, options, log);
    return mesh;
}

} // namespace vcarve
