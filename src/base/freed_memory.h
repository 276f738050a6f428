#pragma once

namespace vcarve {

/// Gives memory that was freed back to the system. The allocators keep it for later, and what comes
/// next may not fit what they keep: after a parallel triangulation oneTBB's keeps up to 400 bytes a
/// point, after a dense cloud is thinned the C library's 100. Cost: some milliseconds.
void return_freed_memory();

} // namespace vcarve
