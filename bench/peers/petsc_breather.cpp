// Error and time of the breather of breather.cpp by the method of lines with time integrators of PETSc. The rows are
// like those of that program. Space has differences of second or fourth order.

#include <petscts.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>

namespace {

constexpr double m = 0.5, reach = 40;
const double omega = std::sqrt(1 - m * m), start = -1.5 * std::numbers::pi / omega,
             end = 0.75 * std::numbers::pi / omega;

double breather(double x, double t) { return -4 * std::atan(m / omega * std::sin(omega * t) / std::cosh(m * x)); }

struct Lines {
  PetscInt sites;
  double h;
  bool fourth_order;

  double x(PetscInt j) const { return -reach + static_cast<double>(j) * h; }
  /// u_tt at inner sites; the others are at rest.
  void accelerations(const PetscScalar* u, PetscScalar* a) const {
    const double factor = 1 / (h * h);
    std::fill(a, a + sites, 0.0);
    for (PetscInt j = 2; j + 2 < sites; ++j) {
      const double second = u[j - 1] + u[j + 1] - 2 * u[j];
      const double wide = u[j - 2] + u[j + 2] - 2 * u[j];
      a[j] = factor * (fourth_order ? (16 * second - wide) / 12 : second) - std::sin(u[j]);
    }
  }
};

PetscErrorCode copy_velocities(TS, PetscReal, Vec velocity, Vec rates, void*) { return VecCopy(velocity, rates); }

PetscErrorCode accelerate(TS, PetscReal, Vec u, Vec rates, void* context) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscCall(VecGetArrayRead(u, &from));
  PetscCall(VecGetArray(rates, &to));
  static_cast<const Lines*>(context)->accelerations(from, to);
  PetscCall(VecRestoreArrayRead(u, &from));
  return VecRestoreArray(rates, &to);
}

/// The rates of u and, after these, of u_t.
PetscErrorCode all_rates(TS, PetscReal, Vec state, Vec rates, void* context) {
  const Lines* const lines = static_cast<const Lines*>(context);
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscCall(VecGetArrayRead(state, &from));
  PetscCall(VecGetArray(rates, &to));
  std::copy(from + lines->sites, from + 2 * lines->sites, to);
  lines->accelerations(from, to + lines->sites);
  PetscCall(VecRestoreArrayRead(state, &from));
  return VecRestoreArray(rates, &to);
}

struct Method {
  const char* name;
  TSType type;
  const char* variant;
  bool fourth_order;
  double step;  ///< over the spacing
};

PetscErrorCode choose(TS ts, const Method& method, Lines& lines) {
  PetscCall(TSSetType(ts, method.type));
  if (method.type == std::string_view(TSRK)) {
    PetscCall(TSRKSetType(ts, method.variant));
    return TSSetRHSFunction(ts, nullptr, all_rates, &lines);
  }
  PetscCall(TSBasicSymplecticSetType(ts, method.variant));
  IS position = nullptr, momentum = nullptr;
  PetscCall(ISCreateStride(PETSC_COMM_SELF, lines.sites, 0, 1, &position));
  PetscCall(ISCreateStride(PETSC_COMM_SELF, lines.sites, lines.sites, 1, &momentum));
  PetscCall(TSRHSSplitSetIS(ts, "position", position));
  PetscCall(TSRHSSplitSetIS(ts, "momentum", momentum));
  PetscCall(TSRHSSplitSetRHSFunction(ts, "position", nullptr, copy_velocities, &lines));
  PetscCall(TSRHSSplitSetRHSFunction(ts, "momentum", nullptr, accelerate, &lines));
  PetscCall(ISDestroy(&position));
  return ISDestroy(&momentum);
}

PetscErrorCode solve(const Method& method, Lines& lines, Vec state, double* seconds) {
  TS ts = nullptr;
  TSAdapt adapt = nullptr;
  PetscLogDouble begun = 0, done = 0;
  const double steps = std::ceil((end - start) / (method.step * lines.h));
  PetscCall(TSCreate(PETSC_COMM_SELF, &ts));
  PetscCall(choose(ts, method, lines));
  PetscCall(TSGetAdapt(ts, &adapt));
  PetscCall(TSAdaptSetType(adapt, TSADAPTNONE));
  PetscCall(TSSetTime(ts, start));
  PetscCall(TSSetTimeStep(ts, (end - start) / steps));
  PetscCall(TSSetMaxSteps(ts, static_cast<PetscInt>(steps)));
  PetscCall(TSSetMaxTime(ts, 2 * end));
  PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_STEPOVER));
  PetscCall(TSSetSolution(ts, state));
  PetscCall(TSSetUp(ts));
  PetscCall(PetscTime(&begun));
  PetscCall(TSSolve(ts, state));
  PetscCall(PetscTime(&done));
  *seconds = done - begun;
  return TSDestroy(&ts);
}

PetscErrorCode run(const Method& method, double h) {
  Lines lines{static_cast<PetscInt>(std::lround(2 * reach / h)) + 1, h, method.fourth_order};
  double least = 1e9, error = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    Vec state = nullptr;
    PetscScalar* u = nullptr;
    double seconds = 0;
    PetscCall(VecCreateSeq(PETSC_COMM_SELF, 2 * lines.sites, &state));
    PetscCall(VecGetArray(state, &u));
    for (PetscInt j = 0; j < lines.sites; ++j) u[j] = breather(lines.x(j), start);
    PetscCall(VecRestoreArray(state, &u));
    PetscCall(solve(method, lines, state, &seconds));
    PetscCall(VecGetArray(state, &u));
    error = 0;
    for (PetscInt j = 0; j < lines.sites; ++j) error = std::fmax(error, std::fabs(u[j] - breather(lines.x(j), end)));
    PetscCall(VecRestoreArray(state, &u));
    PetscCall(VecDestroy(&state));
    least = std::fmin(least, seconds);
  }
  std::printf("PETSc %s\t%.6g\t%.4e\t%.4e\n", method.name, h, error, least);
  std::fflush(stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  PetscCall(PetscInitialize(&argc, &argv, nullptr, nullptr));
  const Method methods[] = {{"Verlet, 3-point", TSBASICSYMPLECTIC, "2", false, 0.95},
                            {"symplectic 4, 5-point", TSBASICSYMPLECTIC, "4", true, 0.5},
                            {"RK 4, 5-point", TSRK, TSRK4, true, 1},
                            {"RK 5dp, 5-point", TSRK, TSRK5DP, true, 0.8}};
  for (const Method& method : methods)
    for (const double h : {0.8, 0.64, 0.5, 0.4, 0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625})
      if (h > 0.03 || !method.fourth_order) PetscCall(run(method, h));
  return PetscFinalize();
}
