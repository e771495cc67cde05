// The compiler embeds the numbers of the files *.csv, in which a comma follows each number.

#include <bit>

#include "friction/ratio/layout.hpp"

namespace slipfront::friction_ratio {
namespace {

constexpr double ratio_numbers[] = {
#include "friction/ratio/coefficients.csv"
};
constexpr double corner_numbers[] = {
#include "friction/ratio/corners.csv"
};
constexpr front_layout::Integer front_numbers[] = {
#include "friction/ratio/front_coefficients.csv"
};
constexpr front_layout::Integer drop_numbers[] = {
#include "friction/ratio/drop_coefficients.csv"
};

}  // namespace

constinit const layout::Table coefficients = std::bit_cast<layout::Table>(ratio_numbers);
constinit const layout::Corners corners = std::bit_cast<layout::Corners>(corner_numbers);
constinit const front_layout::FrontTable front_coefficients = std::bit_cast<front_layout::FrontTable>(front_numbers);
constinit const front_layout::DropTable drop_coefficients = std::bit_cast<front_layout::DropTable>(drop_numbers);

}  // namespace slipfront::friction_ratio
