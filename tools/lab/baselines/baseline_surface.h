#pragma once

#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

namespace vcarve {

/// What Akgunduz, Zetu and Banerjee (2000, section 2) hold strict carving against: solids that know
/// the points only, and nothing of the views.
enum class Baseline { alpha_shape, sculpture };

/// The surface of a baseline, from the same points and cells as our own, with all its faces, mended
/// alike: with the labels of the baseline, and the other steps at their defaults. `alpha` is a
/// multiple of smallest_whole_alpha(). Throws InputError where the scene holds too little for a
/// surface, and where no cell is as small as alpha asks for.
TriMesh baseline_surface(Scene model, Baseline baseline, double alpha = 1.0);

} // namespace vcarve
