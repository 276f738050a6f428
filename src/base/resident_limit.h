#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

namespace vcarve {

/// The resident memory of a process, in bytes.
struct ResidentSize {
    std::int64_t all = 0;
    std::int64_t of_files = 0; ///< file-backed pages, which can be read back
};

/// The resident memory of this process; nothing if the system does not report it.
std::optional<ResidentSize> resident_size();

/// Limits the resident memory of the process to `most` bytes, with a thread that lives as long as
/// the object. It checks every 20 ms, or every 3 ms above half the limit, and drops pages that are
/// registered as DroppablePages (bytes_to_drop()). Threads that fill memory faster can exceed the
/// limit between two checks. Other memory is not limited. If the process's cgroup is nearly full,
/// dropped pages are also written back at once, so that reclaiming memory need not wait for the
/// disk.
class ResidentLimit {
  public:
    explicit ResidentLimit(std::int64_t most);
    ResidentLimit(const ResidentLimit&) = delete;
    ResidentLimit& operator=(const ResidentLimit&) = delete;
    ~ResidentLimit();

  private:
    void watch();
    bool waits(std::chrono::milliseconds pause);

    std::int64_t most_;
    std::mutex mutex_;
    std::condition_variable ends_;
    bool is_over_ = false;
    std::thread thread_;
};

/// The bytes of file pages to drop if `most` may be resident. 0 up to 5/8 of `most`. Above, enough
/// to reach half of `most`, so that not every check has to drop pages. File pages of an eighth of
/// `most` always stay, even if other memory exceeds the limit: work would come to a halt.
std::int64_t bytes_to_drop(const ResidentSize& now, std::int64_t most);

} // namespace vcarve
