#pragma once

#include "io/work/stage_keeper.h"
#include "model/labels.h"
#include "model/tet_mesh.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

namespace vcarve {

/// Labels each cell outside or inside by the sights of the scene. With virtual viewpoints, the
/// cells are labelled once by the real sights, viewpoints are placed in the space that is then
/// known to be free, and the cells are labelled again with the sights of both. The labels do not
/// depend on the number of threads. Cost: a walk for each sight, and that of the labelling (see
/// strict_carving.h, cut.h and hull_faces.h). What the sights say and the labels are stages that
/// `work` keeps: "sights", "virtual-sights" and "labels".
Labels label_cells(const TetMesh& cells, const Scene& scene, const LabelOptions& options,
                   StageKeeper& work);

} // namespace vcarve
