#pragma once

#include "baselines/alpha_shape.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

namespace vcarve {

/// What Akgunduz, Zetu and Banerjee (2000, section 2) hold strict carving against: solids that know
/// the points only, and nothing of the views.
enum class Baseline { alpha_shape, sculpture };

/// "alpha shape" or "sculpture".
const char* name_of(Baseline baseline);

/// The surface of a baseline, from the same points and cells as our own, with all its faces, mended
/// alike: steps 1, 2 and 5 at their defaults, with the labels of the baseline. Throws InputError
/// where the scene holds too little for a surface, and where no cell is as small as alpha asks for.
TriMesh baseline_surface(Scene model, Baseline baseline, const AlphaOptions& options);

} // namespace vcarve
