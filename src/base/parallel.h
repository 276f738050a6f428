#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace vcarve {

/// Calls body(i) for every i in [0, count), from as many threads as the surrounding tbb arena has.
/// The body must not depend on the order of the calls.
template <typename Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1024)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              body(i);
                          }
                      });
}

} // namespace vcarve
