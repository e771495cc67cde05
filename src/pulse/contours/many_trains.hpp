#pragma once
/// \file
/// A pulse without friction, with as many trains at one position as overtake each other (docs/theory/9_trains.md 9.6).
/// The curves of the edges move in the plane of x and rapidity r:
///     dr / dt = 0,   dx / dt = v_j(all edges at x),   Eq. (9.2).
/// A curve that folds over makes two trains out of one. Nothing breaks, so that there are no shocks. The ends of the
/// domain are not seen: a train continues outside with the stress of the end, or there is none.

#include <optional>
#include <string>
#include <vector>

#include "foundation/math/step_control.hpp"
#include "pulse/contours/contour.hpp"
#include "pulse/motion.hpp"

namespace slipfront::pulse {

class Along;

/// The part of a checkpoint that describes the motion of many trains at one time.
struct ManyTrainsState {
  double time = 0, steps = 0;
  double step = 0;             ///< length that the error of the last step recommends; 0 before the first one
  std::vector<double> x = {};  ///< positions of the points
  SlipRecord slip = {};        ///< at x = 0

  void archive(Archive& a) {
    a.same(std::string("many trains"));
    a(time, steps, step, slip);
    a.fixed(x);
    a.require(steps >= 0 && steps < 9e15);
  }
};

class ManyTrains : public Motion {
 public:
  explicit ManyTrains(Problem problem);
  ManyTrains(const ManyTrains&) = delete;  // the sweep refers to the contour
  ManyTrains& operator=(const ManyTrains&) = delete;

  const Problem& problem() const override { return problem_; }
  double time() const override { return state_.time; }
  long steps() const override { return static_cast<long>(state_.steps); }
  bool advance_to(double target, const std::function<bool()>& after_step) override;
  bool aimed_at_target() const override { return aimed_; }
  double expected_steps(double duration) const override;
  std::string reason_of_short_steps() const override;

  void archive(Archive& a) override;

  output::Snapshot observe(const output::Schedule& schedule) const override;
  output::Findings findings(const std::vector<output::Snapshot>& snapshots) const override;
  std::optional<SlipTwice> slip_twice() const override;
  double conservation_error() const override;

  /// The curves at t = 0 and now.
  const Contour& start() const { return start_; }
  const Contour& contour() const { return now_; }

 private:
  std::optional<SlipTwice> slip_twice(const Along& along) const;
  void step(double target);
  /// One attempt at a step of this length from these positions. It changes state_.x.
  StepAttempt attempt(const std::vector<double>& before, double length);
  /// The speeds of all points if they are at x.
  void find_speeds(const std::vector<double>& x, std::vector<double>& speeds);
  bool remove_sawteeth();
  double first_step() const;

  Problem problem_;
  Contour start_, now_;
  Sweep sweep_{now_};
  ManyTrainsState state_;
  bool aimed_ = false;
  std::vector<double> speeds_;  ///< at the present positions; empty: not known
  std::vector<double> stage_, second_, third_, last_;
};

}  // namespace slipfront::pulse
