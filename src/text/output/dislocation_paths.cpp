#include "slipfront/text/output/dislocation_paths.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

namespace slipfront::output {
namespace {

constexpr std::size_t no_number = static_cast<std::size_t>(-1);

using Dislocations = std::vector<Dislocation>;
using Indices = std::vector<std::size_t>;

/// A dislocation of an earlier snapshot.
struct Known {
  Dislocation dislocation;
  std::size_t number;
  double time;      ///< at which it was last seen
  double velocity;  ///< mean since it was seen before, no faster than c; NaN if it was seen once
};

bool has_both_signs(const Dislocations& all) {
  const auto is_positive = [](const Dislocation& d) { return d.sign > 0; };
  const auto positive = std::count_if(all.begin(), all.end(), is_positive);
  return positive > 0 && positive < static_cast<std::ptrdiff_t>(all.size());
}

long charge(const Dislocations& all) {
  long sum = 0;
  for (const Dislocation& d : all) sum += d.sign;
  return sum;
}

/// n, if u is between (2 n - 1) pi and (2 n + 1) pi left of all dislocations.
long left_well(const Dislocations& all) { return all.front().level + (all.front().sign > 0 ? 1 : 0); }

Indices of_sign(const Dislocations& all, int sign) {
  Indices found;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].sign == sign) found.push_back(i);
  return found;
}

/// Continues the dislocations of one snapshot, and some that were lost before it, in the next snapshot.
class Successors {
 public:
  /// The first of `known` are `before`, the dislocations of the last snapshot.
  Successors(const std::vector<Known>& known, const Dislocations& before, const Snapshot& now, double ring_length)
      : known_(known),
        before_(before),
        now_(now.dislocations),
        time_(now.time),
        ring_length_(ring_length),
        numbers_(now_.size(), no_number),
        velocities_(now_.size(), std::numeric_limits<double>::quiet_NaN()),
        is_free_(known.size(), 1) {
    for (const Known& one : known) last_x_.push_back(one.dislocation.x);
  }

  /// For each dislocation the number that it continues, or no_number.
  Indices numbers() {
    if (ring_length_ == 0 && has_both_signs(before_) && has_both_signs(now_) && continue_in_order()) return numbers_;
    const auto sign = [](const Dislocation& d) { return std::pair(d.sign, 0L); };
    if (ring_length_ == 0 && has_antidislocations()) continue_nearest(expected_positions(), true, sign);
    const long once_around = ring_length_ > 0 ? std::labs(charge(now_)) : 0;
    const std::vector<double> of_last(last_x_.begin(), last_x_.begin() + static_cast<std::ptrdiff_t>(before_.size()));
    continue_nearest(of_last, false, [once_around](const Dislocation& d) {
      const long level = once_around > 0 ? (d.level % once_around + once_around) % once_around : d.level;
      return std::pair(d.sign, level);
    });
    if (has_antidislocations()) continue_nearest(last_x_, true, sign);
    return numbers_;
  }
  /// After `numbers`: the velocity of each dislocation, NaN if it is new.
  const std::vector<double>& velocities() const { return velocities_; }

 private:
  /// A dislocation that has no other end yet.
  struct Single {
    double x, reach;  ///< `reach` is the longest way that one of earlier can have gone
    bool is_new;
    std::size_t index;
  };
  using Singles = std::vector<Single>;

  /// Whether levels can change: those of one sign keep their levels.
  bool has_antidislocations() const {
    const int sign = now_.empty() ? 0 : now_.front().sign;
    return std::any_of(now_.begin(), now_.end(), [&](const Dislocation& d) { return d.sign != sign; }) ||
           std::any_of(known_.begin(), known_.end(), [&](const Known& k) { return k.dislocation.sign != sign; });
  }
  double reach_of(std::size_t known) const { return time_ - known_[known].time; }  // no faster than c

  void connect(std::size_t known, std::size_t now) {
    numbers_[now] = known_[known].number;
    velocities_[now] = std::clamp((now_[now].x - last_x_[known]) / reach_of(known), -1.0, 1.0);
    is_free_[known] = 0;
  }

  /// Rule 2: where the known dislocations are now at constant velocity, NaN for those without one. Those of one sign
  /// keep their order: fast ones hand their velocity over.
  std::vector<double> expected_positions() const {
    std::vector<double> expected(known_.size(), std::numeric_limits<double>::quiet_NaN());
    for (const int sign : {1, -1}) {
      Indices some;
      for (std::size_t i = 0; i < known_.size(); ++i)
        if (known_[i].dislocation.sign == sign && !std::isnan(known_[i].velocity)) some.push_back(i);
      std::sort(some.begin(), some.end(), [&](std::size_t a, std::size_t b) { return last_x_[a] < last_x_[b]; });
      std::vector<double> x;
      for (const std::size_t i : some) x.push_back(last_x_[i] + known_[i].velocity * reach_of(i));
      std::sort(x.begin(), x.end());
      for (std::size_t i = 0; i < some.size(); ++i) expected[some[i]] = x[i];
    }
    return expected;
  }

  /// Rule 1. Returns whether it applies.
  bool continue_in_order() {
    if (before_.size() != now_.size() || charge(before_) != charge(now_) || left_well(before_) != left_well(now_))
      return false;
    for (const bool connects : {false, true})
      for (const int sign : {1, -1}) {
        const Indices from = of_sign(before_, sign), to = of_sign(now_, sign);
        for (std::size_t i = 0; i < from.size(); ++i) {
          if (connects)
            connect(from[i], to[i]);
          else if (std::fabs(now_[to[i]].x - before_[from[i]].x) > reach_of(from[i]))
            return false;
        }
      }
    return true;
  }

  /// Connects known dislocations, at these x unless it is NaN, to those of the same `kind`, the nearest first.
  template <class Kind>
  void continue_nearest(const std::vector<double>& x, bool limited, const Kind& kind) {
    std::map<std::pair<int, long>, Singles> all;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (is_free_[i] && !std::isnan(x[i]))
        all[kind(known_[i].dislocation)].push_back({x[i], limited ? reach_of(i) : HUGE_VAL, false, i});
    for (std::size_t i = 0; i < now_.size(); ++i)
      if (numbers_[i] == no_number) all[kind(now_[i])].push_back({now_[i].x, HUGE_VAL, true, i});
    for (auto& [key, singles] : all) {
      std::stable_sort(singles.begin(), singles.end(), [](const Single& a, const Single& b) { return a.x < b.x; });
      while (connect_nearest(singles)) {
      }
    }
  }

  /// Connects all pairs that are nearer to each other than to any other single, and removes them. The nearest of all
  /// pairs is one of them. Returns whether there was one.
  bool connect_nearest(Singles& singles) {
    const std::size_t n = singles.size();
    if (n < 2) return false;
    std::vector<double> way_to_next(n, HUGE_VAL);
    for (std::size_t i = 0; i < (ring_length_ > 0 ? n : n - 1); ++i) {
      const Single &one = singles[i], &next = singles[(i + 1) % n];
      const double way = next.x - one.x + (i + 1 < n ? 0 : ring_length_);
      if (one.is_new != next.is_new && way <= std::fmin(one.reach, next.reach)) way_to_next[i] = way;
    }
    std::vector<char> is_connected(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n;
      const double way = way_to_next[i];
      if (way == HUGE_VAL || is_connected[i] || is_connected[next]) continue;
      if (way > way_to_next[(i + n - 1) % n] || way > way_to_next[next]) continue;
      connect(singles[singles[i].is_new ? next : i].index, singles[singles[i].is_new ? i : next].index);
      is_connected[i] = is_connected[next] = 1;
    }
    Singles rest;
    for (std::size_t i = 0; i < n; ++i)
      if (!is_connected[i]) rest.push_back(singles[i]);
    singles = std::move(rest);
    return singles.size() < n;
  }

  const std::vector<Known>& known_;
  const Dislocations &before_, &now_;
  double time_, ring_length_;
  Indices numbers_;
  std::vector<double> velocities_, last_x_;
  std::vector<char> is_free_;
};

}  // namespace

DislocationPaths dislocation_paths(const std::vector<Snapshot>& snapshots, const PathSettings& settings) {
  DislocationPaths paths;
  std::vector<Known> known;
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    const Snapshot& now = snapshots[i];
    const Dislocations before = i > 0 ? snapshots[i - 1].dislocations : Dislocations();
    Successors successors(known, before, now, settings.ring_length);
    Indices numbers = i > 0 ? successors.numbers() : Indices(now.dislocations.size(), no_number);
    std::vector<Known> seen;
    for (std::size_t j = 0; j < numbers.size(); ++j) {
      if (numbers[j] == no_number) {
        numbers[j] = paths.signs.size();
        paths.signs.push_back(now.dislocations[j].sign);
      }
      seen.push_back({now.dislocations[j], numbers[j], now.time, successors.velocities()[j]});
    }
    // Those that are not seen may be so again. The next output may be as far from this one as this one from the last.
    std::vector<char> is_seen(paths.signs.size(), 0);
    for (const std::size_t number : numbers) is_seen[number] = 1;
    const double longest = i > 0 ? std::fmax(settings.meeting_time, now.time - snapshots[i - 1].time) : 0;
    for (const Known& one : known)
      if (!is_seen[one.number] && now.time - one.time <= longest) seen.push_back(one);
    known = std::move(seen);
    paths.numbers.push_back(std::move(numbers));
  }
  return paths;
}

}  // namespace slipfront::output
