// Stands for the page in a build without npm.

#include "service/dashboard/server/page.hpp"

namespace adstar::dashboard {

std::span<const PageFile> page_files() { return {}; }

}  // namespace adstar::dashboard
