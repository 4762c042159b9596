#pragma once
// DDS Security of one participant: the packaged plugins, and the files that they are to use.

#include "service/dds/qos.hpp"
#include "service/scene/security_files.hpp"

namespace adstar::dds {

/// For dds_create_participant. Throws ConfigurationError: a file that cannot be used, plugins that
/// are not installed.
QosHandle make_security_qos(const scene::SecurityFiles& files);

}  // namespace adstar::dds
