#pragma once
/// \file
/// Three points of a distribution, by which samples and populations are summed up.

namespace slipfront::catalogue {

struct Quantiles {
  double low;  ///< 5 %
  double median;
  double high;  ///< 95 %
};

}  // namespace slipfront::catalogue
