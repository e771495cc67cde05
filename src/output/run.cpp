#include "slipfront/output/run.hpp"

#include "foundation/archive.hpp"

namespace slipfront::output {

std::string Run::saved() const { return slipfront::saved(*this); }

}  // namespace slipfront::output
