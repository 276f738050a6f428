#pragma once

#include "vcarve/io.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace vcarve {

/// Writes what write_ply() does into a stream, whose errors are left to whoever owns it. Where
/// there is a texture, the names are those of its pages' files.
void write_ply(std::ostream& out, const TriMesh& mesh, const MeshFormat& format,
               const std::vector<std::string>& page_names);

} // namespace vcarve
