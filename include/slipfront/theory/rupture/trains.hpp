#pragma once
/// \file
/// Several trains of dislocations at the same position: the exact averages without friction, and the speeds of the
/// modulation (docs/theory/9_trains.md). Each dislocation has a rapidity r, and moves at tanh(r) where it is alone. A
/// train fills a band of rapidities; N trains fill N bands. The 2 N edges of the bands are the Riemann invariants.
/// Sources: Forest & McLaughlin (1983), Stud. Appl. Math. 68, 11-59; Ercolani, Forest & McLaughlin (1984), Stud. Appl.
/// Math. 71, 91-101; Grinevich & Novikov (2003), J. Math. Phys. 44, 3174.

#include <cstddef>
#include <span>
#include <vector>

#include "slipfront/theory/train.hpp"

namespace slipfront::rupture {

/// The bands of N trains, from the lowest rapidity up. We store widths, not edges, because slow trains have widths of
/// 1e-9 and less, which differences of edges would not resolve.
struct FilledBands {
  double centre = 0;           ///< rapidity half-way between the lowest and the highest edge
  std::vector<double> widths;  ///< 2 N - 1 widths: band, gap, band, ... band

  std::size_t trains() const { return (widths.size() + 1) / 2; }
  /// The 2 N edges, rising.
  std::vector<double> edges() const;
};

/// The bands between these rising edges.
FilledBands bands_of_edges(std::span<const double> edges);
/// The band of one uniform train: its edges are phi - psi and phi + psi. The state must not be empty.
FilledBands bands_of_train(const State& train);

/// The speed of each edge: d r_j / d t + v_j d r_j / d x = 0. A band or gap may have the width 0, which gives the
/// limit: in an empty band the speed of one dislocation among the others, at a closed gap that of a wave without
/// amplitude. For N = 1 they are lambda_- and lambda_+ of Eq. 6. The error is at most 1e-12 of the larger of the
/// speed and the greatest difference of two speeds, for widths from 1e-303 to 5; it is 1e-11 for three or more trains
/// that spread over more than 7. Speeds of slow trains keep their relative precision. \throws InputError unless each
/// width is 0 or at least 1e-303, their sum is at most 80 and |centre| at most 80.
std::vector<double> edge_speeds(const FilledBands& bands);

/// The averages over each train.
struct TrainShare {
  double k;      ///< wave number, 2 pi times the number of its dislocations per unit length
  double omega;  ///< frequency, 2 pi times the number of its dislocations that pass in a unit of time
  double I;      ///< wave action
  double J;      ///< flux of wave action
};

/// The averages over all trains. Conservation laws without friction: k_t + W_x = 0, P_t + Q_x = 0, H_t + P_x = 0, and
/// d k / d t + d omega / d x = 0, d I / d t + d J / d x = 0 for each train.
struct BandAverages {
  std::vector<double> speeds;      ///< edge_speeds of the bands
  std::vector<TrainShare> trains;  ///< from the lowest band up
  double k;                        ///< stress, the sum of all k
  double W;                        ///< slip velocity, the sum of all omega
  double P;                        ///< momentum density <sigma w>, also the energy flux
  double H;                        ///< energy density
  double Q;                        ///< momentum flux
  double squared_rate;             ///< <u_t^2>, the sum of all omega I
};

/// The averages of N trains (docs/theory/9_trains.md 9.2), for widths from 1e-303 to 5. The relative error is 1e-12 of
/// k and H; of omega, P and Q too, where the lowest and highest edge do not differ in sign. There it is 1e-12 of the
/// sizes that cancel. For three or more trains that spread over more than 7, 1e-11 replaces 1e-12. The error of I and J
/// is 1e-12 of |I| + |J|, and 1e-11 for widths below 1e-100. Two trains take 4 to 17 microseconds, and their speeds 1
/// to 4 microseconds. \throws InputError like edge_speeds, and if a width is 0.
BandAverages averages(const FilledBands& bands);

/// Derivatives with respect to the edges, at [j] for edge j. Those of W, P, Q follow: each is v_j times that of k, H,
/// P.
struct BandDerivatives {
  std::vector<double> speeds;
  std::vector<std::vector<double>> k;  ///< [j][i]: d k_i / d r_j; d omega_i / d r_j is v_j times that
  std::vector<double> H;               ///< d H / d r_j; d P / d r_j is v_j times that, and d Q / d r_j v_j^2 times
};

/// The derivatives by the variation of a hyperelliptic curve (Rauch's formula), not by differences.
/// \throws InputError like averages.
BandDerivatives derivatives(const FilledBands& bands);

/// The changes d r_j / d t of the edges at one position by a load F and viscous friction C w, for one or two trains
/// (docs/theory/9_trains.md 9.7). Dislocations are neither made nor lost, P gains F k - C P, and H gains
/// F W - C <u_t^2>. A band or gap narrower than 1e-7 of the sum of all widths counts as that wide.
/// \throws InputError like edge_speeds, and for three or more trains.
std::vector<double> edge_sources(const FilledBands& bands, double load, double viscosity);

}  // namespace slipfront::rupture
