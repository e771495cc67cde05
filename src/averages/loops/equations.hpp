#pragma once
/// \file
/// The averaged equations of star-shaped ruptures in space. With g = r_theta / r,
///     r_t = U sqrt(1 + g^2)
///     Pi_t = (r p)_q - l H0 + T_theta + g T + r <1 - cos u> (a^2)_q + 2 pi r (F - <f>)
///     T = 2 pi J0 g cosh(phi) / sqrt(1 + g^2)
/// where U is the velocity of the loops along their normal.

#include <cstddef>
#include <vector>

#include "averages/loops/loops.hpp"

namespace slipfront::plane {

class LoopEquations {
 public:
  LoopEquations(const Problem& problem, const Loops& loops);

  /// Finds the rates of r and Pi without friction. `s` are the initial guesses of tanh(psi), which it replaces.
  /// \throws NumericsError with time and position if loops cross, or if no state has these numbers.
  void find_rates(double t, const std::vector<double>& r, const std::vector<double>& momentum, std::vector<double>& s,
                  std::vector<double>& r_rate, std::vector<double>& momentum_rate);

  // Results of the last call, cell by cell.
  const std::vector<double>& phi() const { return phi_; }
  const std::vector<double>& psi() const { return psi_; }
  /// Spacing of the loops along the ray, and their velocity along it.
  const std::vector<double>& spacing() const { return spacing_; }
  const std::vector<double>& velocity() const { return along_ray_; }
  const std::vector<double>& contact() const { return contact_; }  ///< empty: 1
  double contact(std::size_t cell) const { return contact_.empty() ? 1 : contact_[cell]; }
  Point centre(std::size_t cell) const {
    const std::size_t k = cell % angles_;
    return {middle_[cell] * cosine_[k], middle_[cell] * sine_[k]};
  }
  double middle(std::size_t cell) const { return middle_[cell]; }
  /// Largest stable step after the last call.
  double longest_step() const;
  double supply() const { return supply_; }  ///< power of F

 private:
  void find_shapes(const std::vector<double>& r);
  void find_contacts(const std::vector<double>& r);
  void solve(double t, std::vector<double>& s);
  void find_faces(const std::vector<double>& r, std::vector<double>& r_rate);
  struct Side {
    double phi, psi;
  };
  Side outer_side(std::size_t row, std::size_t k) const;
  Side inner_side(std::size_t row, std::size_t k) const;
  void find_outer_face(std::size_t k);
  void find_inner_face(const std::vector<double>& r, std::size_t k);
  void add_pressure(const std::vector<double>& r, std::vector<double>& rate) const;
  void add_tension(std::vector<double>& rate);
  void add_contact_force(std::vector<double>& rate) const;
  void add_forcing(double t, std::vector<double>& rate);
  void derivative(const double* row, double* slope) const;
  double slope(const std::vector<double>& f, std::size_t row, std::size_t k) const;
  std::size_t face(std::size_t row, std::size_t k) const { return row * angles_ + k; }
  std::size_t around(std::size_t k, int step) const;

  const Problem& problem_;
  std::size_t rows_, angles_;
  double turn_;
  std::vector<double> label_, wall_, cosine_, sine_;
  // Cells.
  std::vector<double> middle_, spacing_, bend_, normal_spacing_, normal_momentum_, contact_;
  std::vector<double> phi_, psi_, sound_, EK_, velocity_, along_ray_, solved_, log_psi_;
  // Faces.
  std::vector<double> face_bend_, face_phi_, face_psi_, face_contact2_;
  std::vector<double> stiffness_, tension_;  ///< one row
  double supply_ = 0;
  double closing_ = 0;  ///< largest rate at which a cell loses its width, over the width
};

}  // namespace slipfront::plane
