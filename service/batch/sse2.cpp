#include "service/batch/table.hpp"

namespace adstar::batch {

constinit const Table kSse2Table = KernelTable<xsimd::sse2>::table();

}  // namespace adstar::batch
