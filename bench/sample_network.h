#pragma once

#include "model/flow_network.h"
#include "model/tet_mesh.h"

#include <cstddef>
#include <string>

namespace vcarve {

struct SampleNetwork {
    TetMesh cells; ///< neighbours and mirrors only
    FlowNetwork network;
};

/// The network of soft visibility of points on a bumpy closed surface, with noise of about their
/// spacing and one outlier in thirty, seen from a ring of views; sights are pushed along their
/// walks.
SampleNetwork make_sample_network(std::size_t points);

/// Raw files of the machine's own byte order: the number of cells (64 bits); per cell 4 neighbours
/// (32 bits each); per cell its mirrors (8 bits); per cell 4 residuals (32 bits each); per cell the
/// excess (32 bits).
SampleNetwork read_network(const std::string& path);
void write_network(const std::string& path, const SampleNetwork& sample);

} // namespace vcarve
