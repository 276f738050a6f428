#pragma once

/// @file
/// All of the library: read a model, reconstruct its surface, write it, measure it.

#include "vcarve/compare.h"
#include "vcarve/error.h"
#include "vcarve/io.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"
#include "vcarve/region.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"
