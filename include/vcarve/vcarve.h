#pragma once

/// @file
/// The whole library: read a model, reconstruct its surface, write and measure meshes.

/// @mainpage
/// Include vcarve/vcarve.h. vcarve::read_model reads a COLMAP model into a vcarve::Scene, which you
/// can also fill yourself with viewpoints, points and tracks. vcarve::reconstruct makes a mesh,
/// vcarve::write_mesh writes it, and vcarve::compare measures meshes. The folder `examples` has a
/// program for each.
///
/// Link `vcarve::vcarve`, from `find_package(vcarve 0.3)`, pkg-config or `add_subdirectory`. The
/// library has no globals, prints nothing, and may be used from several threads at a time. It
/// throws vcarve::UsageError, vcarve::InputError, and vcarve::Cancelled if your vcarve::Log stops a
/// run. Results are byte-identical for any thread count.

#include "vcarve/compare.h"
#include "vcarve/error.h"
#include "vcarve/io.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"
#include "vcarve/region.h"
#include "vcarve/scene.h"
#include "vcarve/texture.h"
#include "vcarve/tri_mesh.h"
