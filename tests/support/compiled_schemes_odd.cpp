#include "tests/support/compile_schemes.hpp"

namespace adstar::test {

constinit const std::array<CompiledScheme, kSchemes> kOddSchemes = compile_half<1>();

}  // namespace adstar::test
