#include "compare/compare.h"

namespace vcarve {

std::optional<std::int64_t> genus(const MeshCheck& check)
{
    const bool sound = check.is_closed() && check.is_manifold() && check.orientation_faults == 0 &&
                       check.degenerate_faces == 0;
    if (!sound) return std::nullopt;
    return check.components - check.euler_characteristic / 2;
}

Comparison compare_mesh(const NamedMesh& named, const Reference& reference)
{
    const MeasuredMesh mesh = place_mesh(named, reference);
    Comparison comparison;
    comparison.name = named.name;
    comparison.size = check_mesh(mesh.mesh);
    comparison.genus = genus(comparison.size);
    comparison.evidence = measure_against_views(mesh, reference);
    if (reference.truth) comparison.truth = measure_against_truth(mesh, reference);
    return comparison;
}

} // namespace vcarve
