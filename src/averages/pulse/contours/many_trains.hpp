#pragma once
/// \file
/// A pulse with as many trains at one position as overtake each other (docs/theory/9_trains.md 9.6). The curves of the
/// edges move in the plane of x and rapidity r:
///     dx / dt = v_j(all edges at x),                Eq. (9.2)
///     dr / dt = s_j(all edges at x, F, C).          Eq. (9.11)
/// Viscous friction C and a load F change rapidities; their effect is known for up to two trains. A curve that folds
/// over makes two trains out of one. Nothing breaks, so that there are no shocks. The ends of the domain are not seen:
/// a train continues outside with the stress and the load of the end, or there is none.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "averages/pulse/contours/contour.hpp"
#include "averages/pulse/motion.hpp"
#include "math/time_steps.hpp"

namespace slipfront::pulse {

class Along;

/// Positions and rapidities of all points, or their velocities.
struct Points {
  std::vector<double> x, r;
};

/// Work of friction, load and the ends of the domain since t = 0.
struct Work {
  double dissipated = 0, supplied = 0;         ///< energy, in the domain
  double through_ends = 0;                     ///< energy that came in through the ends of the domain
  double slip_at_left = 0, slip_at_right = 0;  ///< far outside the domain, where a load moves uniform trains
};

/// The part of a checkpoint that describes the motion of many trains at one time.
struct ManyTrainsState {
  double time = 0, steps = 0;
  double third_train = none;  ///< x at which friction or a load acts on three trains now; NaN: nowhere
  double step = 0;            ///< length that the error of the last step recommends; 0 before the first one
  Contour curves = {};
  Work work = {};
  SlipRecord slip = {};  ///< at x = 0

  void archive(Archive& a) {
    a.same(std::string("many trains"));
    a(time, steps, third_train, step, curves, work, slip);
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
  /// Whether trains move relative to each other for longer than a wave takes to cross ten cells. If friction is
  /// stronger, the points do not resolve how little moves until then, and one train is as good from the start.
  static bool can_follow(const Problem& problem);
  /// Whether one train at each position has to take over. Friction wears the motion of the trains relative to each
  /// other off, and at last no points resolve them (docs/theory/9_trains.md 9.7). A third train also ends this motion.
  bool is_over() const { return time() >= last_time(problem_) || !std::isnan(state_.third_train); }

  void archive(Archive& a) override;

  output::Snapshot observe(const output::Schedule& schedule) const override;
  output::Findings findings(const std::vector<output::Snapshot>& snapshots) const override;
  std::optional<SlipTwice> slip_twice() const override;
  double conservation_error() const override;
  /// A warning if a third train ends this motion; otherwise empty.
  std::string third_train() const;
  const SlipRecord& slip() const { return state_.slip; }

  /// The curves at t = 0 and now.
  const Contour& start() const { return start_; }
  const Contour& contour() const { return now_; }
  /// Whether friction or a load acts.
  bool driven() const { return viscosity_ != 0 || problem_.forcing; }
  const Work& work() const { return state_.work; }

 private:
  std::optional<SlipTwice> slip_twice(const Along& along) const;
  /// Time at which one train takes over.
  static double last_time(const Problem& problem);
  void step(double target);
  /// One attempt at a step of this length from these points. It changes the points of the state.
  StepAttempt attempt(const Points& before, double length);
  /// The velocities of all points, of x and of r, at one time.
  void find_velocities(double time, const Points& points, Points& velocities);
  edges::Forces forces(double x, double time) const;
  /// Velocities of the curves' ends outside the domain.
  void find_changes_of_ends(double time, Points& velocities) const;
  /// Rates of change of the work now.
  Work power() const;
  void add_work(double length);
  bool remove_sawteeth();
  struct Interval {
    double left, right;
  };
  Interval driven_stretch() const;
  bool refine();
  bool extend(double side);
  Points points() const { return {state_.curves.x, state_.curves.r}; }
  double first_step() const;

  Problem problem_;
  Contour start_, now_;
  Sweep sweep_{now_};
  ManyTrainsState state_;
  bool aimed_ = false;
  double viscosity_ = 0;
  Points velocities_;  ///< those of the present points, empty if not known
  struct {
    double extent = 0, x = 0;
  } third_train_;  ///< the last x at which friction or a load acts on three trains, and the size of that region
  std::optional<Work> power_;  ///< rate of the work now, empty if not known
  Points stage_, second_, third_, last_;
};

}  // namespace slipfront::pulse
