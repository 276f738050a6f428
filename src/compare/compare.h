#pragma once

#include "compare/evidence.h"
#include "compare/reference.h"
#include "compare/truth.h"
#include "mesh/check.h"

#include <cstdint>
#include <optional>
#include <string>

namespace vcarve {

/// What a program took to make a mesh, from its start to its end.
struct RunCost {
    double seconds = 0.0;
    double cpu_seconds = 0.0; ///< of all threads, user and system
    std::int64_t peak_memory_bytes = 0;
};

/// Everything measured of one mesh.
struct Comparison {
    std::string name;
    std::string failure;         ///< why there is no mesh; then all that follows means nothing
    std::optional<RunCost> cost; ///< where it was made for the comparison
    MeshCheck size;
    std::optional<std::int64_t> genus; ///< of a closed, manifold, consistently oriented surface
    EvidenceFigures evidence;
    std::optional<TruthFigures> truth; ///< where the reference has one
};

/// The number of handles, summed over the pieces; nothing where the surface is not closed, manifold
/// and consistently oriented, or has degenerate faces.
std::optional<std::int64_t> genus(const MeshCheck& check);

/// make_reference() and add_closed_surface(), as the stages "reference" and "closed".
Reference complete_reference(Scene model, const NamedMesh* truth, const CompareOptions& options,
                             Log& log);

/// Measures a mesh, as the stage "measure". The same mesh, reference and options give the same
/// figures for any number of threads. Throws InputError where the mesh has no surface or lies in
/// another frame (see place_mesh).
Comparison compare_mesh(const NamedMesh& named, const Reference& reference, Log& log);

} // namespace vcarve
