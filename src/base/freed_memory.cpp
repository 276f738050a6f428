#include "base/freed_memory.h"

#include <tbb/scalable_allocator.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace vcarve {

void return_freed_memory()
{
    scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr);
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

} // namespace vcarve
