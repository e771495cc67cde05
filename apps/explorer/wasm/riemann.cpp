/// \file
/// Panel "Riemann": two uniform trains meet at x = 0.

#include "slipfront/rupture/riemann.hpp"

#include <algorithm>
#include <cmath>

#include "answer.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::explorer {
namespace {

using rupture::RiemannSolution;
using rupture::Wave;

Object described(const State& state) {
  const train::Averages a = train::averages(state);
  return Object()
      .put("phi", state.phi)
      .put("psi", state.psi)
      .put("U", std::tanh(state.phi))
      .put("Sigma", a.k)
      .put("W", a.W)
      .put("P", a.P)
      .put("H", a.H);
}

Object described(const Wave& wave) {
  return Object().put("kind", rupture::name_of(wave.kind)).put("outer", wave.outer).put("inner", wave.inner);
}

/// The states that a wave passes through, from the outer to the inner side.
void put_path(Object& object, const std::string& name, const RiemannSolution& solution, const Wave& wave) {
  std::vector<double> phi, psi, x;
  if (wave.kind == Wave::Kind::fan) {
    constexpr int points = 60;
    for (int i = 0; i <= points; ++i) {
      x.push_back(wave.outer + (wave.inner - wave.outer) * i / points);
      const State state = rupture::sample(solution, x.back());
      phi.push_back(state.phi);
      psi.push_back(state.psi);
    }
  }
  object.put(name, Object().numbers("phi", phi).numbers("psi", psi).numbers("x_over_t", x));
}

}  // namespace

SLIPFRONT_EXPORT const char* riemann(double left_stress, double left_velocity, double right_stress,
                                     double right_velocity, int points) {
  return answer([=] {
    const State left = rupture::moving_train(left_stress, left_velocity, "left");
    const State right = rupture::moving_train(right_stress, right_velocity, "right");
    if (left.empty() && right.empty())
      throw InputError({.key = "left_stress", .problem = "both sides are empty", .allowed = "a stress on one side"});
    const RiemannSolution s = rupture::solve_riemann(left, right);
    const rupture::Edges edges = rupture::edges_of(s);
    Object object;
    object.put("left", described(s.left)).put("right", described(s.right)).put("star", described(s.star));
    object.put("left_wave", described(s.left_wave)).put("right_wave", described(s.right_wave));
    object.put("left_edge", edges.left).put("right_edge", edges.right);
    put_path(object, "left_path", s, s.left_wave);
    put_path(object, "right_path", s, s.right_wave);
    const double width = std::max(edges.right - edges.left, 1e-12);
    std::vector<double> x, Sigma, W, U;
    for (int i = 0; i < std::clamp(points, 2, 20000); ++i) {
      x.push_back(edges.left - 0.25 * width + 1.5 * width * i / (std::clamp(points, 2, 20000) - 1));
      const State state = rupture::sample(s, x.back());
      const train::Averages a = train::averages(state);
      Sigma.push_back(a.k);
      W.push_back(a.W);
      U.push_back(state.empty() ? 0 : std::tanh(state.phi));
    }
    return object.numbers("x_over_t", x).numbers("Sigma", Sigma).numbers("W", W).numbers("U", U);
  });
}

}  // namespace slipfront::explorer
