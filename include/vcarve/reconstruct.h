#pragma once

#include "vcarve/io.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <filesystem>

namespace vcarve {

/// A surface and what of the scene it was made from, centred.
struct Reconstruction {
    Scene scene;  ///< the points that passed the filter, in the order TriMesh::points counts them
    TriMesh mesh; ///< in the frame of `scene`: both have the same offset
};

/// From a scene to its surface: the steps in order, on `options.threads` threads; the result does
/// not depend on how many. `log` is told of every stage, and asked all the time whether to stop.
///
/// Throws, before any work, UsageError where an option is out of its range (naming it, what was
/// found and what is accepted) or the arrays of the scene do not fit each other, and InputError
/// where the run, in memory, would need more than `options.memory.most`; later InputError where the
/// scene holds too little for a surface, or the file of a region is wrong. Throws Cancelled within
/// a fraction of a second after Log::wants_stop says so. Holds no globals: several runs may go on
/// side by side.
///
/// All arrays are in memory, where the caller's operator new puts them, so both words "auto" of
/// MemoryOptions mean no limit and no blocks here: to choose by what is free, and to keep arrays in
/// files, is what the program does. Blocks that are asked for bound what the triangulation takes.
Reconstruction reconstruct(Scene input, const Options& options, Log& log);

/// Reads a model, as read_model() does, and reconstructs it; the surface is the same. Of a dense
/// cloud with a file of visibility not all points are in memory at a time: they are merged
/// (ThinOptions) while they are read, as part of the stage "read". Throws what both throw.
Reconstruction reconstruct(const std::filesystem::path& input, const PointsOptions& points,
                           const Options& options, Log& log);

} // namespace vcarve
