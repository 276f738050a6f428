#pragma once

#include "vcarve/provenance.h"
#include "vcarve/tri_mesh.h"

#include <pybind11/pybind11.h>

namespace vcarve::python {

/// A surface in the frame of the model, and what it comes from where that was asked for.
struct Mesh {
    TriMesh surface; ///< its offset is zero
    Provenance provenance;
    pybind11::dict counts; ///< what every stage of the run counted
};

/// Positions are those of the model: the offset is added, which leaves what is written as it is.
TriMesh in_frame_of_model(TriMesh mesh);

/// Throws UsageError naming the first face with a vertex that does not exist. Users can write into
/// the arrays of a mesh at any time.
void require_corners(const TriMesh& mesh);

/// Mesh, whose arrays are NumPy's at the same addresses.
void add_mesh_class(pybind11::module_& module);

} // namespace vcarve::python
