#include "steps/5_labels/label_cells.h"

#include "steps/5_labels/cut.h"
#include "steps/5_labels/hull_faces.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vcarve {

CutCells cut_cells(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
                   const LabelOptions& options, const Progress& progress)
{
    const std::vector<Index> uncrossed = uncrossed_hull_cells(cells, energy.network);
    CutCells made;
    made.labels = cut(cells, std::move(energy), options.cut, progress);
    made.inside = std::ranges::count(made.labels, Label::inside);
    made.on_hull = go_on_along_hull(cells, scene, uncrossed, options.hull, made.labels);
    return made;
}

} // namespace vcarve
