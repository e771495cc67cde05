#pragma once
/// \file
/// The averages of many trains along x, and their integrals from the left.

#include <vector>

#include "averages/pulse/contours/contour.hpp"
#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::pulse {

class ManyTrains;

/// At positions x: the dislocations to the left at t = 0 and now, and the momentum of the latter; densities now.
struct Counted {
  std::vector<double> x, first, now, momentum, density, momentum_density;
};

/// Slip is the integral of the stress at t = 0 less that now, from where nothing has moved.
class Along {
 public:
  /// `x_edges`: edges of the cells of a profile, if one is wanted.
  explicit Along(const ManyTrains& trains, const std::vector<double>& x_edges = {});

  double slip_at_origin() const { return slip(at(0)); }
  /// 2 pi times the dislocations in the domain at t = 0.
  double count() const { return count_; }
  double conservation_error() const;
  Counted counted() const;
  /// All of a snapshot but what output::complete adds.
  output::Snapshot snapshot(const output::Schedule& schedule) const;

 private:
  double slip(std::size_t node) const;
  /// Index of a node at x.
  std::size_t at(double x) const;
  bool in_domain(std::size_t node) const;
  void find_nodes(const std::vector<double>& x_edges);
  void integrate();
  void add_energy(std::size_t node, double weight, const edges::Means& now, const edges::Means& first);
  void spread_uncounted(const std::vector<double>& changed);
  output::Profile profile(const std::vector<double>& x_edges) const;
  void find_peak(output::Snapshot& s) const;
  output::Fronts fronts(double threshold, double peak) const;
  double trailing_front() const;
  double leading_front() const;
  double visible(double x) const;

  const ManyTrains& trains_;
  std::vector<double> nodes_;          ///< x, rising: points of curves now and at t = 0, and those of the profile
  std::vector<edges::Means> means_;    ///< at the nodes
  std::vector<double> stress_, lost_;  ///< integrals from the left up to each node: of k, and of k less that at t = 0
  std::vector<double> before_, momentum_;  ///< integrals of k at t = 0, and of P now
  double count_ = 0, uncounted_ = 0;
  output::Energy energy_{};
};

}  // namespace slipfront::pulse
