#include "event_keep.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "batch.hpp"
#include "interrupts.hpp"
#include "progress.hpp"
#include "slipfront/catalogue/population.hpp"
#include "slipfront/results/quantities.hpp"
#include "slipfront/results/serialize.hpp"

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::inference;
using namespace slipfront::finite_fault;
using namespace slipfront::results;

namespace {

class Catalogue {
 public:
  Catalogue(std::vector<Entry>&& entries, const medium::Defaults& defaults, const EvaluationOptions& plan,
            const EventKeeping& keeping)
      : entries_(std::move(entries)),
        defaults_(defaults),
        plan_(plan),
        keeping_(keeping),
        results_(entries_.size()),
        is_done_(entries_.size()) {}

  void resume() {
    std::vector<SavedResult> found = deserialize(record::read_events_done(keeping_.resume, keeping_.metadata));
    if (found.size() > entries_.size()) throw FileError(keeping_.resume + ": holds more events than the catalogue");
    done_ = found.size();
    for_each_parallel(done_, keeping_.threads, [&](std::size_t i) {
      results_[i] = evaluate(std::move(entries_[i]), defaults_, plan_, std::move(found[i]));
      is_done_[i] = 1;
    });
  }

  /// As many of the next events as a tenth of a second allows, one at least.
  void go_on() {
    const auto start = Clock::now();
    const std::size_t next = std::min<std::size_t>(4096, results_.size() - done_);
    for_each_parallel(
        next, keeping_.threads,
        [&](std::size_t j) {
          const std::size_t i = done_ + j;
          if (is_done_[i] || (j > 0 && (seconds_since(start) > 0.1 || interrupted_by_user()))) return;
          results_[i] = evaluate(std::move(entries_[i]), defaults_, plan_);
          is_done_[i] = 1;
        },
        1);
    while (done_ < results_.size() && is_done_[done_]) ++done_;
  }

  void write() {
    if (!keeping_.output.wanted()) return;
    const auto begun = Clock::now();
    Population population;
    for (const EventResult& r : done())
      if (const auto member = member_of(r)) population.add(*member);
    record::write_events(finished() ? keeping_.output.finished() : keeping_.output.unfinished(), keeping_.metadata,
                         done(), population.decades(), finished());
    if (finished()) keeping_.output.clear();
    written_ = Clock::now();
    cost_ = seconds_since(begun);
  }

  /// A checkpoint is the whole file: writing it must stay a small part of the work.
  bool checkpoint_due() const { return seconds_since(written_) > std::max(0.2, 20 * cost_); }

  bool finished() const { return done_ == results_.size(); }
  std::size_t count_done() const { return done_; }

  std::vector<EventResult> results() && {
    results_.resize(done_);
    return std::move(results_);
  }

 private:
  std::span<const EventResult> done() const { return std::span(results_).first(done_); }

  std::vector<Entry> entries_;
  const medium::Defaults& defaults_;
  const EvaluationOptions& plan_;
  const EventKeeping& keeping_;
  std::vector<EventResult> results_;
  std::vector<char> is_done_;  ///< a few beyond the first `done_` may be
  std::size_t done_ = 0;
  Clock::time_point written_ = Clock::now();
  double cost_ = 0;
};

}  // namespace

KeptEvents evaluate_and_keep(std::vector<Entry>&& entries, const medium::Defaults& defaults,
                             const EvaluationOptions& plan, const EventKeeping& keeping) {
  const auto total = static_cast<double>(entries.size());
  Catalogue catalogue(std::move(entries), defaults, plan, keeping);
  interrupted_means(keeping.output.wanted()
                        ? "; what was written last stays: go on with " + keeping.output.how_to_resume()
                        : "; nothing was written: -o OUT.nc could be resumed");
  const WatchInterrupts watch;
  if (!keeping.resume.empty())
    catalogue.resume();
  else if (!keeping.output.replaces())
    catalogue.write();  // a path that cannot be written is known before the work
  {
    Progress progress(total, !keeping.quiet, {}, {"", "events", 8});
    const auto at = [&] { return catalogue.count_done(); };
    progress.from(static_cast<double>(at()), static_cast<long>(at()));
    while (!catalogue.finished() && !interrupted_by_user()) {
      catalogue.go_on();
      progress.at(static_cast<double>(at()), static_cast<long>(at()));
      if (!catalogue.finished() && catalogue.checkpoint_due()) catalogue.write();
    }
  }
  catalogue.write();
  const bool finished = catalogue.finished();
  return {std::move(catalogue).results(), finished};
}
