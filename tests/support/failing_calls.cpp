// An LD_PRELOAD library that makes system calls fail after main() has begun. VCARVE_FAILS selects
// them: "write:3" is the third call of write, "write:3+" the third and all later ones. The first
// failure creates the file VCARVE_FAILED. If the file is missing, the program made fewer calls.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace {

std::atomic<bool> has_begun = false;
std::atomic<long> count = 0;
int (*real_main)(int, char**, char**) = nullptr;

struct Wanted {
    const char* call = "";
    std::size_t length = 0;
    long number = 0;
    bool continues = false;
};
Wanted wanted;

void read_wanted()
{
    const char* const text = std::getenv("VCARVE_FAILS");
    const char* const colon = text == nullptr ? nullptr : std::strchr(text, ':');
    if (colon == nullptr) return;
    char* end = nullptr;
    wanted = {text, static_cast<std::size_t>(colon - text), std::strtol(colon + 1, &end, 10)};
    wanted.continues = *end == '+';
}

/// Counts a call, and returns whether it must fail; then sets errno to `error`.
bool fails(const char* call, int error)
{
    if (!has_begun || std::strlen(call) != wanted.length) return false;
    if (std::memcmp(call, wanted.call, wanted.length) != 0) return false;
    const long number = ++count;
    if (number < wanted.number || (number > wanted.number && !wanted.continues)) return false;
    if (const char* const mark = std::getenv("VCARVE_FAILED")) {
        ::syscall(SYS_close, ::syscall(SYS_open, mark, O_CREAT | O_WRONLY, 0600));
    }
    errno = error;
    return true;
}

template <typename Function>
Function next(Function, const char* name)
{
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// Whether glibc registers the destructor of a thread-local variable; it aborts if that fails.
bool notes_destructor(const void* caller)
{
    Dl_info info;
    return ::dladdr(caller, &info) != 0 && info.dli_sname != nullptr &&
           std::string_view(info.dli_sname) == "__cxa_thread_atexit_impl";
}

int watched_main(int argc, char** argv, char** environment)
{
    read_wanted();
    has_begun = true;
    return real_main(argc, argv, environment);
}

} // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

using Main = int(int, char**, char**);
using StartMain = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);

int __libc_start_main(Main* main, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end)
{
    real_main = main;
    auto* const real = reinterpret_cast<StartMain*>(::dlsym(RTLD_NEXT, "__libc_start_main"));
    return real(watched_main, argc, argv, init, fini, rtld_fini, stack_end);
}

void* malloc(std::size_t bytes) noexcept
{
    return fails("malloc", ENOMEM) ? nullptr : __libc_malloc(bytes);
}
void* calloc(std::size_t number, std::size_t bytes) noexcept
{
    const bool may_fail = !has_begun || !notes_destructor(__builtin_return_address(0));
    return may_fail && fails("malloc", ENOMEM) ? nullptr : __libc_calloc(number, bytes);
}
void* realloc(void* memory, std::size_t bytes) noexcept
{
    return fails("malloc", ENOMEM) ? nullptr : __libc_realloc(memory, bytes);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) noexcept
{
    if (fails("malloc", ENOMEM)) return ENOMEM;
    *memory = __libc_memalign(alignment, bytes);
    return *memory == nullptr ? ENOMEM : 0;
}

ssize_t write(int file, const void* bytes, std::size_t size)
{
    if (fails("write", ENOSPC)) return -1;
    return ::syscall(SYS_write, file, bytes, size);
}
int rename(const char* from, const char* to) noexcept
{
    if (fails("rename", EIO)) return -1;
    return static_cast<int>(::syscall(SYS_rename, from, to));
}
int fsync(int file)
{
    if (fails("fsync", EIO)) return -1;
    return static_cast<int>(::syscall(SYS_fsync, file));
}
void* mmap(void* place, std::size_t size, int protection, int flags, int file,
           off_t offset) noexcept
{
    if (fails("mmap", ENOMEM)) return MAP_FAILED;
    return reinterpret_cast<void*>(
        ::syscall(SYS_mmap, place, size, protection, flags, file, offset));
}
int open(const char* path, int flags, ...)
{
    std::va_list rest;
    va_start(rest, flags);
    const auto mode = va_arg(rest, unsigned);
    va_end(rest);
    if (fails("open", EMFILE)) return -1;
    return static_cast<int>(::syscall(SYS_open, path, flags, mode));
}
std::FILE* fopen(const char* path, const char* mode)
{
    if (fails("open", EMFILE)) return nullptr;
    return next(&fopen, "fopen")(path, mode);
}

void* mmap64(void*, std::size_t, int, int, int, off_t) noexcept __attribute__((alias("mmap")));
int open64(const char*, int, ...) __attribute__((alias("open")));
std::FILE* fopen64(const char*, const char*) __attribute__((alias("fopen")));

} // extern "C"
