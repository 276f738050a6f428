#pragma once

namespace vcarve {

/// Asks the processor for the memory at an address, which will be needed soon. The address need not
/// be valid.
inline void prefetch([[maybe_unused]] const void* address)
{
#if defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

} // namespace vcarve
