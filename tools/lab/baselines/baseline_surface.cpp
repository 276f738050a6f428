#include "baselines/baseline_surface.h"

#include "baselines/alpha_shape.h"
#include "baselines/sculpt.h"
#include "mesh/half_edge_mesh.h"
#include "steps/1_points/arrange.h"
#include "steps/1_points/filter.h"
#include "steps/3_cells/triangulate.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/6_surface/cleanup.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vcarve {

namespace {

Labels labels_of(Baseline baseline, const TetMesh& cells, double alpha)
{
    if (baseline == Baseline::sculpture) return sculpt(cells);
    Labels labels = alpha_shape(cells, alpha * smallest_whole_alpha(cells));
    if (std::ranges::count(labels, Label::inside) == 0) {
        throw InputError(fmt::format("no cell is as small as the alpha {} asks for: 1 is the "
                                     "smallest that keeps all points",
                                     alpha));
    }
    return labels;
}

} // namespace

TriMesh baseline_surface(Scene model, Baseline baseline, double alpha)
{
    const Scene scene = spatial_sort(filter_points(center_points(std::move(model)), {}).scene);
    const TetMesh cells = triangulate(scene);
    const Labels labels = labels_of(baseline, cells, alpha);
    return tri_mesh(*clean_surface(extract_surface(cells, labels, scene), {}).mesh);
}

} // namespace vcarve
