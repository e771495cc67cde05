// Checks chains that several processes (ranks) share. mpirun starts it with any number of ranks (tests/CMakeLists.txt):
//     ranks_check same              A shared chain has the bits of a single process. Errors reach all ranks.
//     ranks_check save FILE         Runs the first half and saves the state.
//     ranks_check resume FILE       Runs the second half and compares the bits with a run in one piece.
//     ranks_check lost              Only rank 1 fails. All ranks end with exit code 3.
// If a check fails, it prints the difference and returns 1.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/explicit/forces.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"
#include "lattice/chain/implicit/implicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "lattice/chain/scaled_start.hpp"
#include "rough_chains.hpp"
#include "slipfront/error.hpp"
#include "system/archive.hpp"
#include "system/ranks.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

constexpr std::size_t sites = 1501;
constexpr long half_way = 150, all_the_way = 301;
int wrong = 0;

void expect(bool right, const std::string& what) {
  if (right) return;
  std::fprintf(stderr, "differs: %s\n", what.c_str());
  ++wrong;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// All measurements on a chain, in one row.
std::vector<double> measured(const Chain& chain) {
  std::vector<double> row;
  const double later = chain.constant_step().value_or(0) / 3;
  const Window w = chain.window(3, chain.problem().grid.sites - 1, chain.time() + later);
  for (const auto* values : {&w.x, &w.u, &w.velocity, &w.stress, &w.contact_squared, &w.effective_stress})
    row.insert(row.end(), values->begin(), values->end());
  const Totals t = totals(chain);
  for (const double sum : {t.charge, static_cast<double>(t.dislocations), t.kinetic, t.elastic, t.substrate, t.momentum,
                           t.loading, chain.load()})
    row.push_back(sum);
  for (const Dislocation& d : dislocations(chain)) row.insert(row.end(), {d.x, static_cast<double>(d.sign)});
  const Average a = average(chain, 290, 80, chain.time());  // the window crosses the boundaries between ranks
  row.insert(row.end(), {a.u, a.velocity, a.stress});
  const SmoothAverage smooth = smooth_average(chain, 290, 80, chain.time());
  row.insert(row.end(), {smooth.velocity, smooth.stress, smooth.energy});
  return row;
}

struct Outcome {
  Levels levels;
  std::vector<double> row;
};

Outcome outcome(const Problem& p, const MotionOf& start, const Execution& execution) {
  ExplicitChain chain(p, start, execution);
  chain.advance(all_the_way);
  Outcome out{chain.levels(), measured(chain)};
  const Flows flows = chain.flows();
  out.row.insert(out.row.end(), {flows.supplied, flows.dissipated, flows.outflow, flows.by_contacts});
  return out;
}

void compare(const Ranks& ranks, const Problem& p, const MotionOf& start, const std::string& what) {
  const Outcome alone = outcome(p, start, {});
  for (const int threads : {1, 2}) {
    const Outcome shared = outcome(p, start, {.threads = threads, .ranks = &ranks});
    const std::string with = what + ", threads " + std::to_string(threads);
    expect(same(shared.row, alone.row), with + ": measured");  // on every rank
    expect(shared.levels.level == all_the_way, with + ": level");
    expect(same(shared.levels.now, ranks.rank() == 0 ? alone.levels.now : std::vector<double>{}), with + ": now");
    expect(same(shared.levels.before, ranks.rank() == 0 ? alone.levels.before : std::vector<double>{}),
           with + ": before");
    expect(same(shared.levels.state, ranks.rank() == 0 ? alone.levels.state : std::vector<double>{}), with + ": state");
  }
}

void same_bits(const Ranks& ranks) {
  for (int kind = 0; kind < cases::kinds; ++kind) {
    const Problem p = cases::problem(sites, kind);
    const Motion start = cases::bumpy(p);
    compare(
        ranks, p,
        [&](std::size_t begin, std::size_t end) -> Motion {
          const auto part = [&](const std::vector<double>& all) {
            return std::vector<double>(all.data() + begin, all.data() + end);
          };
          return {part(start.u), part(start.velocity)};
        },
        "kind " + std::to_string(kind));
  }
  // Each rank creates its own part of a train next to an empty region.
  for (const int kind : {0, 2, 5}) {
    const Problem p = cases::problem(sites, kind);
    compare(ranks, p, StaticTrain([](double x) { return x < 300 ? 0.855 : 0.0; }, p.grid),
            "train, kind " + std::to_string(kind));
  }
  // This chain is long enough to run on several threads.
  const Problem p = cases::problem(9000, 2);
  compare(ranks, p, StaticTrain([](double x) { return x < 1500 ? 0.7 : 0.0; }, p.grid), "9000 sites");
}

/// Chains that move by implicit steps, with events: a ring under rate-and-state friction, a chain that is pulled at its
/// end and whose contacts age, and a chain between fixed ends under a force.
Problem implicit_problem(int kind) {
  Problem p = cases::problem(sites, kind == 0 ? 8 : kind == 1 ? 9 : 2);
  p.implicit = true;
  if (kind == 0) {
    p.contact = [](double x) { return 1 + 0.05 * std::cos(0.1 * x); };
    p.loading = {.stiffness = 5e-3,
                 .velocity = 0.06,
                 .event_velocity = 0.06,
                 .fronts = 7,
                 .stiffness_at = [](double x) { return 4e-3 + 1e-3 * std::sin(0.3 * x); },
                 .velocity_at = [](double x) { return 0.05 + 0.01 * std::cos(0.2 * x); }};
  } else if (kind == 1) {
    p.boundary = {End::free, End::fixed, false, 0};
    p.loading = {.stiffness = 0.1, .velocity = 0.3, .where = Pulled::left, .event_velocity = 0.002};
  } else {
    p.boundary = {End::fixed, End::fixed, false, 0};
    p.forcing = [](double x, double t) { return 0.1 * std::sin(0.1 * x + t); };
  }
  return p;
}

/// All numbers of the slip events of a chain and of their fronts, in one row.
std::vector<double> events_of(const Chain& chain) {
  std::vector<double> row;
  for (const output::SlipEvent& event : chain.events())
    for (const auto& column : output::slip_event_columns()) row.push_back(event.*column.value);
  const output::FrontRecords fronts = chain.fronts();
  for (const output::FrontRecord& event : fronts.events)
    for (const auto* column : {&fronts.x, &event.arrival, &event.stress, &event.traction})
      row.insert(row.end(), column->begin(), column->end());
  return row;
}

void same_implicit_bits(const Ranks& ranks) {
  for (int kind = 0; kind < 3; ++kind) {
    const Problem p = implicit_problem(kind);
    const Motion start = cases::bumpy(p);
    ImplicitChain alone(p, start), shared(p, start, {.threads = 2, .ranks = &ranks});
    const std::string what = "implicit, kind " + std::to_string(kind);
    for (const double time : {0.5, 2.0}) {
      alone.advance_to(time);
      shared.advance_to(time);
      expect(shared.steps() == alone.steps(), what + ": steps");
      expect(same(measured(shared), measured(alone)), what + ": measured");
    }
    expect(alone.steps() > 20, what + ": steps " + std::to_string(alone.steps()));
    expect(kind == 2 || !alone.events().empty(), what + ": has events");
    expect(same(events_of(shared), events_of(alone)), what + ": events");
    const Flows one = alone.flows(), other = shared.flows();
    expect(same({one.supplied, one.dissipated, one.by_contacts}, {other.supplied, other.dissipated, other.by_contacts}),
           what + ": flows");
    const std::string state = saved(shared);  // all numbers are on rank 0
    expect(ranks.rank() != 0 || state == saved(alone), what + ": saved");
  }
}

/// Checks that every rank throws the same error, whose text contains `part`.
template <class Error>
void expect_error(const Ranks& ranks, const std::function<void()>& task, const std::string& part) {
  std::string text = "nothing thrown";
  try {
    task();
  } catch (const Error& error) {
    text = error.what();
  }
  expect(text.find(part) != std::string::npos, "error '" + part + "', but: " + text);
  // The joined texts of all ranks must be copies of this one.
  std::vector<double> letters(text.begin(), text.end());
  std::vector<double> all = ranks.joined(letters), expected;
  for (int r = 0; r < ranks.size(); ++r) expected.insert(expected.end(), letters.begin(), letters.end());
  expect(same(all, expected), "the same error on all ranks: " + text);
}

void errors(const Ranks& ranks) {
  Problem p = cases::problem(sites, 0);
  const Motion start = cases::bumpy(p);
  const Execution shared{.ranks = &ranks};
  p.forcing = [](double x, double t) { return t > 3 && x > 500 ? std::numeric_limits<double>::quiet_NaN() : 0.0; };
  expect_error<NumericsError>(
      ranks, [&] { ExplicitChain(p, start, shared).advance(50); }, "is not a number");
  p = cases::problem(sites, 0);
  Motion steep = start;
  steep.u[1200] += 2;
  expect_error<InputError>(
      ranks, [&] { ExplicitChain(p, steep, shared); }, "too coarse");
  const Problem few = cases::problem(100, 0);
  Problem slow = few;
  slow.implicit = true;
  slow.boundary.right = End::free;
  for (const bool implicit : {false, true})
    if (ranks.size() > 1)
      expect_error<InputError>(
          ranks, [&] { make_chain(implicit ? slow : few, pieces_of(cases::bumpy(few), 100), shared); },
          "too many for 100 sites");
  slow = implicit_problem(2);
  slow.forcing = [](double x, double t) { return t > 3 && x > 500 ? std::numeric_limits<double>::quiet_NaN() : 0.0; };
  expect_error<NumericsError>(
      ranks, [&] { ImplicitChain(slow, cases::bumpy(slow), shared).advance_to(10); }, "the motion at x = 50");
  expect_error<FileError>(
      ranks,
      [&] {
        ranks.together([&] {
          if (ranks.rank() == ranks.size() - 1) throw FileError("the last rank's");
        });
      },
      "the last rank's");
  expect(ranks.any(ranks.rank() == ranks.size() - 1), "any");
}

void write(std::ofstream& file, const std::vector<double>& values) {
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(double)));
}

void save(const Ranks& ranks, const std::string& path) {
  std::ofstream file;
  if (ranks.rank() == 0) file.open(path, std::ios::binary);
  for (int kind = 0; kind < cases::kinds; ++kind) {
    const Problem p = cases::problem(sites, kind);
    ExplicitChain chain(p, cases::bumpy(p), {.ranks = &ranks});
    chain.advance(half_way);
    for (std::size_t begin = 0; begin < sites; begin += 400) {  // in pieces
      const Levels piece = chain.levels(begin, std::min(begin + 400, sites));
      if (ranks.rank() != 0) continue;
      const std::size_t states = piece.now.empty() ? 0 : piece.state.size() / piece.now.size();
      for (std::size_t j = 0; j < piece.now.size(); ++j) {
        write(file, {piece.now[j], piece.before[j]});
        const auto first = piece.state.begin() + static_cast<std::ptrdiff_t>(states * j);
        write(file, {first, first + static_cast<std::ptrdiff_t>(states)});
      }
    }
  }
  for (int kind = 0; kind < 3; ++kind) {
    const Problem p = implicit_problem(kind);
    ImplicitChain chain(p, cases::bumpy(p), {.ranks = &ranks});
    chain.advance_to(1);
    const std::string state = saved(chain);
    const auto size = static_cast<double>(state.size());
    if (ranks.rank() == 0) write(file, {size});
    if (ranks.rank() == 0) file.write(state.data(), static_cast<std::streamsize>(state.size()));
  }
  if (ranks.rank() == 0) expect(file.flush().good(), "written");
}

void resume(const Ranks& ranks, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::size_t skipped = 0;  // numbers of the kinds before
  for (int kind = 0; kind < cases::kinds; ++kind) {
    const Problem p = cases::problem(sites, kind);
    const std::size_t columns = 2 + state_names(p).size();
    const auto read = [&](std::size_t begin, std::size_t end) {  // each rank reads its own sites
      std::vector<double> rows(columns * (end - begin));
      file.seekg(static_cast<std::streamoff>(sizeof(double) * (skipped + columns * begin)));
      file.read(reinterpret_cast<char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(double)));
      expect(file.good(), "read");
      Levels levels;
      levels.level = half_way;
      for (auto row = rows.begin(); row != rows.end(); row += static_cast<std::ptrdiff_t>(columns)) {
        levels.now.push_back(row[0]);
        levels.before.push_back(row[1]);
        levels.state.insert(levels.state.end(), row + 2, row + static_cast<std::ptrdiff_t>(columns));
      }
      return levels;
    };
    ExplicitChain chain(p, half_way, read, {.threads = 2, .ranks = &ranks}), alone(p, cases::bumpy(p));
    chain.advance(all_the_way - half_way);
    alone.advance(all_the_way);
    expect(same(measured(chain), measured(alone)), "resumed, kind " + std::to_string(kind));
    expect(ranks.rank() != 0 || chain.steps() == alone.steps(), "level");
    skipped += columns * sites;
  }
  file.seekg(static_cast<std::streamoff>(sizeof(double) * skipped));
  for (int kind = 0; kind < 3; ++kind) {
    double size = 0;
    file.read(reinterpret_cast<char*>(&size), sizeof size);
    std::string state(static_cast<std::size_t>(size), ' ');
    file.read(state.data(), static_cast<std::streamsize>(state.size()));
    expect(file.good(), "read");
    const Problem p = implicit_problem(kind);
    ImplicitChain chain(p, cases::bumpy(p), {.ranks = &ranks}), alone(p, cases::bumpy(p));
    restore(chain, state);
    for (auto* each : {&chain, &alone}) each->advance_to(2);
    expect(same(measured(chain), measured(alone)), "resumed, implicit, kind " + std::to_string(kind));
    expect(same(events_of(chain), events_of(alone)), "events, implicit");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Ranks ranks = Ranks::of_mpirun();
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "same") {
      same_bits(ranks);
      same_implicit_bits(ranks);
      errors(ranks);
    } else if (what == "save" && argc > 2) {
      save(ranks, argv[2]);
    } else if (what == "resume" && argc > 2) {
      resume(ranks, argv[2]);
    } else if (what == "lost") {
      if (ranks.rank() == 1) throw FileError("rank 1 cannot write");
      ExplicitChain chain(cases::problem(sites, 0), cases::bumpy(cases::problem(sites, 0)), {.ranks = &ranks});
    } else {
      return 2;
    }
  } catch (const std::exception& error) {
    return ranks.failed(3, [&] { std::fprintf(stderr, "%s\n", error.what()); });
  }
  if (ranks.rank() == 0) std::printf("%d rank(s): %s\n", ranks.size(), wrong == 0 ? "the same" : "DIFFERENT");
  return ranks.any(wrong > 0) ? 1 : 0;
}
