#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>

#include "results.hpp"
#include "runs/run.hpp"
#include "runs/tables.hpp"
#include "system/machine.hpp"
#include "system/threads.hpp"

namespace {

using namespace slipfront;
using Overrides = std::vector<std::string>;
using Variables = std::vector<std::string>;

/// The result of one point: its numbers, or the reason why it has none.
struct Outcome {
  std::size_t point;
  std::vector<double> values;
  std::string reason;
};

/// Returns (name, long name, unit of the model, whether it is a result) of each number of a run.
py::list numbers_of(const std::string& command) {
  py::list numbers;
  for (const auto& [about, is_result] : run::numbers_of(command))
    numbers.append(py::make_tuple(std::string(about.name), std::string(about.long_name),
                                  std::string(about.dimensional_unit), is_result));
  return numbers;
}

std::vector<double> numbers(std::vector<run::Row> summary, const Variables& variables,
                            const std::optional<medium::SiUnits>& units) {
  if (units) run::convert(summary, *units);
  std::vector<double> values;
  for (const std::string& variable : variables)
    for (const run::Row& row : summary)
      if (variable == row.about.name) values.push_back(row.number());
  return values;
}

/// The memory that the running points share. A point waits until its need fits in next to that of the others.
class SharedMemory {
 public:
  /// Reserves memory, and releases it when it is destroyed.
  class RankSites {
   public:
    RankSites(SharedMemory& memory, double bytes) : memory_(memory), bytes_(bytes) {}
    RankSites(const RankSites&) = delete;
    RankSites& operator=(const RankSites&) = delete;
    ~RankSites() {
      const std::scoped_lock lock(memory_.mutex_);
      memory_.used_ -= bytes_;
      --memory_.shares_;
      memory_.changed_.notify_all();
    }

   private:
    SharedMemory& memory_;
    double bytes_;
  };

  /// Reserves memory. Waits until there is enough, until no other share exists, or until `stopped`.
  RankSites take(double bytes, const std::atomic<bool>& stopped) {
    std::unique_lock lock(mutex_);
    while (shares_ > 0 && used_ + bytes > all_ && !stopped) changed_.wait_for(lock, std::chrono::milliseconds(50));
    used_ += bytes;
    ++shares_;
    return {*this, bytes};
  }

 private:
  const double all_ = usable_memory();
  double used_ = 0;
  int shares_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// Runs the points of a sweep, each on one thread and without the GIL.
class Sweep {
 public:
  Sweep(std::string command, const RunRequest& scenario, std::vector<Overrides> points, Variables variables)
      : command_(std::move(command)),
        text_(scenario.text),
        file_(scenario.path.empty() ? "scenario" : scenario.path),
        si_(scenario.si),
        points_(std::move(points)),
        variables_(std::move(variables)) {}

  /// Runs points until none remains or stop() is called. Several threads may call it at the same time.
  void work() noexcept {
    try {
      run_points();
    } catch (...) {  // there is no memory to store the result of a point
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      stopped_ = true;
    }
    const std::lock_guard lock(mutex_);
    ++at_rest_;
    changed_.notify_all();
  }
  void stop() { stopped_ = true; }

  /// The error that ended the work, if any. Valid after all workers have finished.
  std::exception_ptr failure() const { return failure_; }

  /// Returns the points that have finished since the last call, and whether all `threads` workers have ended. Waits up
  /// to 50 ms for that.
  std::pair<std::vector<Outcome>, bool> collect(std::size_t threads) {
    std::unique_lock lock(mutex_);
    const bool all = changed_.wait_for(lock, std::chrono::milliseconds(50), [&] { return at_rest_ >= threads; });
    return {std::exchange(finished_, {}), all};
  }

 private:
  void run_points() {
    while (!stopped_) {
      const std::size_t point = next_++;
      if (point >= points_.size()) break;
      Outcome outcome{point, {}, {}};
      try {
        outcome.values = run(point);
      } catch (const std::bad_alloc&) {
        outcome.reason = "out of memory";
      } catch (const std::exception& error) {
        outcome.reason = error.what();
      }
      if (stopped_) break;  // the run may have been interrupted
      const std::lock_guard lock(mutex_);
      finished_.push_back(std::move(outcome));
    }
  }

  std::vector<double> run(std::size_t point) {
    scenario::Scenario s = scenario::read_scenario(text_, file_, points_[point], run::read_table);
    run::choose_units(s, si_);
    const run::Options options{.after_step = [this](double, long) { return stopped_.load(); }};
    const run::Plan plan =
        run::plan_of(command_ == "chain" ? scenario::SolverKind::chain : scenario::SolverKind::pulse, std::move(s));
    const auto share = memory_.take(plan.need.memory, stopped_);
    return numbers(run::carry_out(plan, options).summary, variables_, plan.scenario.results_in);
  }

  std::string command_, text_, file_;
  std::optional<bool> si_;
  std::vector<Overrides> points_;
  Variables variables_;
  SharedMemory memory_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Outcome> finished_;
  std::size_t at_rest_ = 0;
  std::exception_ptr failure_;
};

/// Runs a sweep. Calls deliver([(point, values, reason), ...]) several times a second with the points that have
/// finished since the last call. The sweep stops if `deliver` raises an error, and at Ctrl-C.
void sweep(const std::string& command, const py::dict& arguments, std::vector<Overrides> points, Variables variables,
           int threads, const py::object& deliver) {
  Sweep work(command, request_of(arguments), std::move(points), std::move(variables));
  std::exception_ptr raised;
  /// Returns whether `call` returned without an error. After an error the sweep stops; it throws the first one at its
  /// end.
  const auto comes_back = [&](const auto& call) {
    try {
      call();
      return true;
    } catch (...) {
      if (!raised) raised = std::current_exception();
      work.stop();
      return false;
    }
  };
  {
    const py::gil_scoped_release others_may_run;
    const std::function<void()> body = [&work] { work.work(); };
    const std::vector<std::jthread> workers = start_threads(static_cast<std::size_t>(std::max(threads, 0)), body);
    if (workers.empty()) work.work();
    for (bool all = false, delivers = true; !all;) {
      std::vector<Outcome> outcomes;
      std::tie(outcomes, all) = work.collect(workers.size());
      const py::gil_scoped_acquire lock;
      if (delivers && !outcomes.empty())
        delivers = comes_back([&] {
          py::list rows;
          for (const Outcome& o : outcomes) rows.append(py::make_tuple(o.point, py::cast(o.values), o.reason));
          deliver(rows);
        });
      comes_back([] {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      });
    }
  }
  if (raised) std::rethrow_exception(raised);
  if (work.failure()) std::rethrow_exception(work.failure());
}

}  // namespace

void bind_sweep(py::module_& m) {
  m.def("sweep", sweep);
  m.def("results_in_si",
        [](const py::dict& arguments) { return scenario_of(request_of(arguments)).results_in.has_value(); });
  m.def("numbers_of", numbers_of);
}
