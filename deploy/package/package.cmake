# What is installed besides the core, and the Debian packages made of it: adstar, libadstar-dev, adstar-dashboard.
# The target `packages` makes them; deploy/package.sh is the command that does it all. Decision 0023 says what is where.

set(here ${CMAKE_CURRENT_LIST_DIR})
set(deploy ${PROJECT_SOURCE_DIR}/deploy)
set(share ${CMAKE_INSTALL_DATADIR}/adstar)  # laid out as this tree: paths in help and documents are paths from there
set(units lib/systemd/system)

install(TARGETS adstar adstard adstar-bridge RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT adstar)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs DESTINATION ${share} COMPONENT adstar)
install(FILES ${deploy}/systemd/adstard@.service DESTINATION ${units} COMPONENT adstar)
install(FILES ${deploy}/systemd/adstar.sysusers.conf DESTINATION lib/sysusers.d RENAME adstar.conf COMPONENT adstar)
install(PROGRAMS ${deploy}/systemd/fly.sh DESTINATION lib/adstar RENAME fly COMPONENT adstar)
install(FILES ${deploy}/systemd/standby.conf ${deploy}/systemd/adstard@.service DESTINATION ${share}/deploy/systemd COMPONENT adstar)
install(DIRECTORY ${deploy}/scenes DESTINATION ${share}/deploy COMPONENT adstar)
install(PROGRAMS ${deploy}/security/make.sh DESTINATION ${share}/deploy/security COMPONENT adstar)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/idl DESTINATION ${share} COMPONENT dev FILES_MATCHING PATTERN "*.idl")

install(FILES ${deploy}/systemd/adstar-dashboard.service DESTINATION ${units} COMPONENT dashboard)
install(FILES ${deploy}/systemd/adstar-dashboard.service DESTINATION ${share}/deploy/systemd COMPONENT dashboard)
install(DIRECTORY ${deploy}/prometheus ${deploy}/grafana DESTINATION ${share}/deploy COMPONENT dashboard)

# /etc of the system is no part of a prefix: only what is installed as the system's own goes there.
function(install_setting component directory file name)
  install(CODE "
    set(etc \"\${CMAKE_INSTALL_PREFIX}/etc\")
    if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
      set(etc /etc)
    endif()
    file(INSTALL \"${file}\" DESTINATION \"\${etc}/${directory}\" RENAME \"${name}\")" COMPONENT ${component})
endfunction()
install_setting(adstar adstar ${PROJECT_SOURCE_DIR}/configs/scenes/demo.toml demo.toml)
install_setting(dashboard default ${here}/dashboard/default adstar-dashboard)

# ---- made from the programs themselves: man pages, completion, the papers of a package ------------
set(ADSTAR_PACKAGE_CONTACT "adstar maintainers <maintainers@localhost>" CACHE STRING "Who looks after the packages: name and address")
set(papers ${PROJECT_BINARY_DIR}/package)
add_custom_target(package_papers
  COMMAND bash ${here}/papers.sh ${PROJECT_BINARY_DIR} ${papers} ${PROJECT_VERSION}
          ${ADSTAR_PACKAGE_CONTACT}
  DEPENDS adstar adstard adstar-bridge
  COMMENT "Man pages, completion, changelogs" VERBATIM)
# There when packages are made, and wherever ADSTAR_PAPERS of the environment says.
foreach(component IN ITEMS adstar dev dashboard)
  install(CODE "
    set(papers \"${papers}/${component}\")
    if(DEFINED ENV{ADSTAR_PAPERS})
      set(papers \"\$ENV{ADSTAR_PAPERS}/${component}\")
    endif()
    if(EXISTS \"\${papers}\")
      file(INSTALL \"\${papers}/\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
    endif()" COMPONENT ${component})
endforeach()

# ---- the packages ---------------------------------------------------------------------------------
set(CPACK_GENERATOR DEB)
set(CPACK_OUTPUT_FILE_PREFIX packages)
set(CPACK_PACKAGE_CONTACT ${ADSTAR_PACKAGE_CONTACT})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL adstar dev dashboard)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)  # of the very same version

set(CPACK_DEBIAN_ADSTAR_PACKAGE_NAME adstar)
set(CPACK_DEBIAN_ADSTAR_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ADSTAR_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ADSTAR_PACKAGE_DEPENDS "systemd-standalone-sysusers | systemd")
set(CPACK_DEBIAN_ADSTAR_PACKAGE_RECOMMENDS "openssl")
set(CPACK_DEBIAN_ADSTAR_PACKAGE_SUGGESTS "adstar-dashboard, bash-completion")
set(CPACK_DEBIAN_ADSTAR_DESCRIPTION "real-time attitude propagation of satellites
A daemon that carries the angular momentum of each spacecraft of a scene
with structure-preserving schemes, takes torque commands over DDS, publishes
attitude and momentum, and keeps its beat; a client that commands, watches,
records and propagates without real time; and a systemd unit for each scene.")
set(CPACK_DEBIAN_ADSTAR_PACKAGE_CONTROL_EXTRA
  "${here}/adstar/postinst;${here}/adstar/prerm;${here}/adstar/postrm;${here}/adstar/conffiles")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libadstar-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_DEV_DESCRIPTION "headers and DDS types of adstar
The propagation library, header-only, on Eigen alone: find_package(adstar)
gives adstar::core to CMake. And the DDS types that adstard speaks, as IDL,
for programs of one's own on its bus.")

set(CPACK_DEBIAN_DASHBOARD_PACKAGE_NAME adstar-dashboard)
set(CPACK_DEBIAN_DASHBOARD_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DASHBOARD_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DASHBOARD_DEPENDS adstar)
set(CPACK_DEBIAN_DASHBOARD_PACKAGE_SUGGESTS "prometheus")
set(CPACK_DEBIAN_DASHBOARD_DESCRIPTION "dashboard of adstar as a service
A systemd unit under which adstar dashboard serves its page and its metrics
on 127.0.0.1, alerts for Prometheus over these metrics, and a board of them
for Grafana.")
set(CPACK_DEBIAN_DASHBOARD_PACKAGE_CONTROL_EXTRA
  "${here}/dashboard/postinst;${here}/dashboard/prerm;${here}/dashboard/postrm;${here}/dashboard/conffiles")
include(CPack)

add_custom_target(packages
  COMMAND ${CMAKE_COMMAND} -E rm -rf packages  # of other versions
  COMMAND ${CMAKE_CPACK_COMMAND}
  DEPENDS package_papers
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} USES_TERMINAL VERBATIM)
