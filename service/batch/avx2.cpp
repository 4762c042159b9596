#include "service/batch/table.hpp"

namespace adstar::batch {

constinit const Table kAvx2Table = KernelTable<xsimd::avx2>::table();

}  // namespace adstar::batch
