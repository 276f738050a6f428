// The program's operator new and delete. Large arrays are in the work folder if there is one; all
// others come from the C library as usual. Only the program has these operators, so the library
// never decides where its callers' arrays are.
#include "base/scratch_memory.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

void* from_c_library(std::size_t bytes, std::size_t alignment)
{
    constexpr std::size_t kUsual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;
    const std::size_t asked = std::max<std::size_t>(bytes, 1);
    if (alignment <= kUsual) return std::malloc(asked);
    void* memory = nullptr;
    return ::posix_memalign(&memory, alignment, asked) == 0 ? memory : nullptr;
}

void* allocate(std::size_t bytes, std::size_t alignment = 1)
{
    if (void* const scratch = vcarve::allocate_scratch(bytes, alignment)) return scratch;
    while (true) {
        if (void* const memory = from_c_library(bytes, alignment)) return memory;
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr) throw std::bad_alloc();
        handler();
    }
}

void release(void* memory) noexcept
{
    if (!vcarve::free_scratch(memory)) std::free(memory);
}

} // namespace

// The standard library's other operators new and delete call these ([new.delete] in the C++
// standard). AddressSanitizer's do not, so the variants that std::stable_sort and std::allocator
// call are defined, too.
void* operator new(std::size_t bytes)
{
    return allocate(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment)
{
    return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t& /*null_instead*/) noexcept
{
    try {
        return allocate(bytes);
    } catch (...) {
        return nullptr;
    }
}

void operator delete(void* memory) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::size_t /*bytes*/) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept
{
    release(memory);
}
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept
{
    release(memory);
}
