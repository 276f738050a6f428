#include "base/scratch_memory.h"

#include "base/droppable_pages.h"
#include "base/text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace vcarve {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPage = 4096; ///< smallest page size of any system
constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

/// An owned file descriptor.
class File {
  public:
    explicit File(int descriptor) : descriptor_(descriptor) {}
    File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    File& operator=(File&& other) noexcept
    {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~File()
    {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

/// A mapped file. The order of the members matters: the pages must be unregistered before the file
/// is closed.
struct Block {
    File file;
    std::size_t bytes;
    DroppablePages pages;
};

/// All blocks, and the folder of new ones. Lives as long as the process, because arrays are freed
/// after static objects are destroyed. No memory may be freed while the mutex is locked, because
/// free_scratch() locks it.
struct Blocks {
    std::mutex mutex;
    std::map<void*, Block> by_begin;
    fs::path folder; ///< if is_open; empty for memory
    std::int64_t bytes = 0;
    std::int64_t peak_bytes = 0;
    bool is_open = false;               ///< whether a ScratchMemory exists
    std::atomic<std::size_t> count = 0; ///< of by_begin
};

Blocks& blocks()
{
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): see above
    static auto* const all = new Blocks;
    return *all;
}

[[noreturn]] void refuse(const fs::path& folder, std::string_view reason)
{
    throw ScratchError(
        fmt::format("cannot create a file in the work folder {}: {}", folder.string(), reason));
}

[[noreturn]] void refuse_as_full(const fs::path& folder, std::size_t bytes)
{
    const std::optional<std::int64_t> left = free_space(folder);
    throw ScratchError(fmt::format("the work folder {} is full: {} more are needed, but {} "
                                   "are free",
                                   folder.string(),
                                   byte_size_text(static_cast<std::int64_t>(bytes)),
                                   left ? byte_size_text(*left) : "none"));
}

/// Creates a file that no other process can open. It disappears with its last user.
File unnamed_file(const fs::path& folder)
{
#ifdef O_TMPFILE
    const int unnamed = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC | O_EXCL, 0600);
    if (unnamed >= 0) return File(unnamed);
#endif
    // Some file systems do not support unnamed files.
    std::string name = (folder / "vcarve-XXXXXX").string();
    const int named = ::mkostemp(name.data(), O_CLOEXEC);
    if (named < 0) refuse(folder, std::strerror(errno));
    ::unlink(name.c_str());
    return File(named);
}

/// Sets the size of a file and allocates its disk space. Otherwise writing to a page would kill the
/// process if the disk is full. Checks free space first: a file system may allocate all free space
/// before it fails, and leave none to others meanwhile.
void take_space(int file, std::size_t bytes, const fs::path& folder)
{
    const std::optional<std::int64_t> left = free_space(folder);
    if (left && *left < static_cast<std::int64_t>(bytes)) refuse_as_full(folder, bytes);
    int error = 0;
#ifdef __linux__
    while ((error = ::fallocate(file, 0, 0, static_cast<off_t>(bytes)) == 0 ? 0 : errno) == EINTR) {
    }
    if (error == 0) return;
#else
    error = EOPNOTSUPP;
#endif
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) refuse_as_full(folder, bytes);
    if (error != EOPNOTSUPP && error != ENOSYS) refuse(folder, std::strerror(error));
    if (::ftruncate(file, static_cast<off_t>(bytes)) != 0) refuse(folder, std::strerror(errno));
}

/// Keeps a file open, so that its pages can be written back, or closes it. At most half of the
/// descriptors are used, because a run has to open other files.
File kept_open(File file)
{
    rlimit limit = {};
    const bool is_known = ::getrlimit(RLIMIT_NOFILE, &limit) == 0;
    const rlim_t most = is_known ? limit.rlim_cur / 2 : 0;
    if (static_cast<rlim_t>(file.descriptor()) < most) return file;
    return File(DroppablePages::kNoFile); // the mapping keeps the file
}

void* map(const File& file, std::size_t bytes)
{
    void* const begin =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.descriptor(), 0);
    if (begin == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_DONTFORK
    // A forked child would otherwise write to the parent's arrays.
    static_cast<void>(::madvise(begin, bytes, MADV_DONTFORK));
#endif
#ifdef MADV_NOHUGEPAGE
    // With huge pages each touched byte maps 2 MB. Random access would load gigabytes before the
    // thread of ResidentLimit checks again.
    static_cast<void>(::madvise(begin, bytes, MADV_NOHUGEPAGE));
#endif
    return begin;
}

/// A map of one new block, which can be merged into all blocks without an allocation.
std::map<void*, Block> new_block(std::size_t bytes, const fs::path& folder)
{
    File file = unnamed_file(folder);
    take_space(file.descriptor(), bytes, folder);
    void* const begin = map(file, bytes);
    std::map<void*, Block> block;
    try {
        file = kept_open(std::move(file));
        DroppablePages pages(begin, bytes, file.descriptor());
        block.emplace(begin, Block{std::move(file), bytes, std::move(pages)});
    } catch (...) {
        ::munmap(begin, bytes);
        throw;
    }
    return block;
}

/// The folder of new blocks; nothing if no ScratchMemory exists.
std::optional<fs::path> present_folder()
{
    const std::lock_guard lock(blocks().mutex);
    if (!blocks().is_open) return std::nullopt;
    return blocks().folder;
}

/// Creates new blocks in `folder` from now on. Throws std::logic_error if blocks are open already.
void open_blocks(fs::path folder)
{
    Blocks& all = blocks();
    const std::lock_guard lock(all.mutex);
    if (all.is_open) throw std::logic_error("another ScratchMemory exists");
    all.folder.swap(folder);
    all.is_open = true;
}

} // namespace

ScratchError::ScratchError(const std::string& sentence)
{
    const std::size_t count = std::min(sentence.size(), sentence_.size() - 1);
    std::copy_n(sentence.begin(), count, sentence_.begin());
}

ScratchMemory::ScratchMemory(const fs::path& folder, std::int64_t most_resident)
{
    unnamed_file(folder);
    open_blocks(folder);
    limit_.emplace(most_resident);
}

ScratchMemory::~ScratchMemory()
{
    const std::lock_guard lock(blocks().mutex);
    blocks().is_open = false;
}

std::int64_t ScratchMemory::peak_bytes()
{
    const std::lock_guard lock(blocks().mutex);
    return blocks().peak_bytes;
}

void* allocate_scratch(std::size_t bytes, std::size_t alignment)
{
    // Checked first because nearly all allocations end here, including that of blocks().
    if (bytes < ScratchMemory::kLeastBytes || alignment > kPage) return nullptr;
    const std::optional<fs::path> folder = present_folder();
    if (!folder) return nullptr;
    if (bytes > kNever / 4) throw std::bad_alloc();
    const std::size_t whole_pages = (bytes + kPage - 1) / kPage * kPage;
    std::map<void*, Block> block = new_block(whole_pages, *folder);
    void* const begin = block.begin()->first;
    Blocks& all = blocks();
    const std::lock_guard lock(all.mutex);
    all.by_begin.merge(block);
    all.count = all.by_begin.size();
    all.bytes += static_cast<std::int64_t>(whole_pages);
    all.peak_bytes = std::max(all.peak_bytes, all.bytes);
    return begin;
}

bool free_scratch(void* memory) noexcept
{
    // Nearly all memory ends here, because only blocks start at a page.
    if (memory == nullptr || reinterpret_cast<std::uintptr_t>(memory) % kPage != 0) return false;
    Blocks& all = blocks();
    if (all.count == 0) return false;
    std::map<void*, Block>::node_type block;
    {
        const std::lock_guard lock(all.mutex);
        block = all.by_begin.extract(memory);
        if (block.empty()) return false;
        all.count = all.by_begin.size();
        all.bytes -= static_cast<std::int64_t>(block.mapped().bytes);
    }
    block.mapped().pages = DroppablePages(); // unregister before unmapping
    ::munmap(memory, block.mapped().bytes);
    return true;
}

std::optional<std::int64_t> free_space(const fs::path& folder)
{
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    if (error) return std::nullopt;
    return static_cast<std::int64_t>(std::min(space.available, std::uintmax_t{1} << 62));
}

} // namespace vcarve
