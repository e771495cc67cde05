#include "pulse/grid/cells.hpp"

namespace slipfront::pulse {
namespace {

std::ptrdiff_t at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

}  // namespace

double Cells::left_face(std::size_t cell) const {
  double x = left_edge();
  for (std::size_t i = 0; i < cell; ++i) x += width(i);
  return x;
}

void Cells::find_centres(std::vector<double>& x) const {
  double face = left_edge();
  for (std::size_t i = 0; i < size(); ++i) {
    x[i] = face + width(i) / 2;
    face += width(i);
  }
}

void Cells::insert(std::size_t before, const Cell& cell) {
  unknowns.insert(unknowns.begin() + at(size() + before), cell.momentum);
  unknowns.insert(unknowns.begin() + at(before), cell.width);
  charge.insert(charge.begin() + at(before), cell.charge);
  s.insert(s.begin() + at(before), cell.s);
}

void Cells::erase(std::size_t i) {
  unknowns.erase(unknowns.begin() + at(size() + i));
  unknowns.erase(unknowns.begin() + at(i));
  s.erase(s.begin() + at(i));
  charge.erase(charge.begin() + at(i));
}

void Cells::join(std::size_t i, std::size_t into) {
  if (charge[i] > charge[into]) s[into] = s[i];
  charge[into] += charge[i];
  width(into) += width(i);
  momentum(into) += momentum(i);
  erase(i);
}

}  // namespace slipfront::pulse
