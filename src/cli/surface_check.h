#pragma once

#include "cli/run_log.h"
#include "cli/run_record.h"
#include "mesh/check.h"

#include <string>

namespace vcarve::cli {

/// Checks a surface, as the stage "check": what a record says of it. How many sights meet it from
/// outside is not asked again: `counts` are what the stages before counted.
Json checked(const TriMesh& mesh, const CountsOfStages& counts, Log& log);

/// What a record says where faces that go through others are not counted.
Json check_json(const MeshCheck& check);

/// Throws std::logic_error, which names the command and the model that repeat it, where a surface
/// breaks what is promised of every one: that it is manifold and oriented and has no face with a
/// vertex twice. A boundary, faces that go through others and sights from behind are only counted:
/// the input may leave nothing better.
void require_promised(const Json& surface, const std::string& command, const std::string& model);

} // namespace vcarve::cli
