#include "service/batch/table.hpp"

namespace adstar::batch {

constinit const Table kAvx512Table = KernelTable<xsimd::avx512f>::table();

}  // namespace adstar::batch
