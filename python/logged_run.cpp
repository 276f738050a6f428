#include "logged_run.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace vcarve::python {

namespace py = pybind11;

namespace {

/// The interval between checks for signals.
constexpr std::chrono::milliseconds kPatience(50);

/// A log event of a run: "begin", "share", "end" or "note".
struct Event {
    const char* kind;
    std::string name;
    std::variant<double, Counts> value;
};

/// Queues events of any thread for the thread that may use Python.
class Mailbox final : public Log {
  public:
    void stage_begins(std::string_view name) override
    {
        stage_ = name;
        put({"begin", std::string(name), 0.0});
    }
    void stage_progresses(double share) override { put({"share", stage_, share}); }
    void stage_ends(std::string_view name, const Counts& counts) override
    {
        put({"end", std::string(name), counts});
    }
    void note(std::string_view sentence) override { put({"note", std::string(sentence), 0.0}); }
    bool should_stop() const override { return stops_.load(std::memory_order_relaxed); }

    void stop() { stops_.store(true, std::memory_order_relaxed); }
    void close()
    {
        const std::lock_guard lock(mutex_);
        is_closed_ = true;
        arrived_.notify_one();
    }
    /// Waits for at most kPatience and moves out all events. Returns whether more may follow.
    bool take(std::vector<Event>& events)
    {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, kPatience, [&] { return !events_.empty() || is_closed_; });
        events = std::exchange(events_, {});
        return !is_closed_;
    }

  private:
    void put(Event event)
    {
        const std::lock_guard lock(mutex_);
        events_.push_back(std::move(event));
        arrived_.notify_one();
    }

    std::mutex mutex_;
    std::condition_variable arrived_;
    std::vector<Event> events_;
    std::string stage_; ///< the running stage
    bool is_closed_ = false;
    std::atomic<bool> stops_ = false;
};

void tell(const py::object& listener, const Event& event)
{
    if (const auto* counts = std::get_if<Counts>(&event.value)) {
        py::dict named;
        for_each_number(*counts, [&](const std::string& name, std::int64_t number) {
            named[py::str(name)] = number;
        });
        listener(event.kind, event.name, named);
    } else {
        listener(event.kind, event.name, std::get<double>(event.value));
    }
}

/// Passes events to the listener until the mailbox is closed.
void listen(Mailbox& mailbox, const py::object& listener)
{
    for (bool is_open = true; is_open;) {
        std::vector<Event> events;
        {
            const py::gil_scoped_release released;
            is_open = mailbox.take(events);
        }
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        for (const Event& event : events) {
            tell(listener, event);
        }
    }
}

void join(std::thread& worker)
{
    const py::gil_scoped_release released;
    worker.join();
}

} // namespace

void run_told(const py::object& listener, const std::function<void(Log&)>& work)
{
    Mailbox mailbox;
    std::exception_ptr failure;
    std::thread worker([&] {
        try {
            work(mailbox);
        } catch (...) {
            failure = std::current_exception();
        }
        mailbox.close();
    });
    try {
        listen(mailbox, listener);
    } catch (...) {
        mailbox.stop();
        join(worker);
        throw;
    }
    join(worker);
    if (failure) std::rethrow_exception(failure);
}

} // namespace vcarve::python
