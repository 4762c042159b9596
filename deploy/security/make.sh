#!/usr/bin/env bash
# Makes what DDS Security asks for: two certificate authorities, and a directory for each participant.
#   bash deploy/security/make.sh [--days N] DIR             authorities, a daemon, a commander and a watcher; DIR is new, and yours
#   bash deploy/security/make.sh [--days N] DIR NAME ROLE   one more: daemon, operator, commander, watcher
# Nothing that is there already is overwritten. What each file is: deploy/security/README.md.
set -euo pipefail
umask 077

fail() { echo "make.sh: $1" >&2; exit "${2:-1}"; }
usage() { fail "usage: make.sh [--days N] DIR [NAME daemon|operator|commander|watcher]" 2; }

days=365
if [[ "${1:-}" == --days ]]; then
  [[ "${2:-}" =~ ^[1-9][0-9]{0,4}$ ]] || usage
  days=$2
  shift 2
fi
if [[ $# -ne 1 && $# -ne 3 || -z "${1:-}" || "${1:-}" == -* ]]; then usage; fi
command -v openssl >/dev/null || fail "openssl is missing; try: apt-get install openssl"

dir=$1
authorities=$dir/authorities
# Every topic of service/dds/topics.hpp: what moves a daemon, and what it says.
torques=(torque_command wheel_torque_command wheel_speed_command dipole_command thruster_command joint_torque_command)
clock=(step_request run_control)
standby=(standby_beat standby_record standby_state)
telemetry=(command_status attitude_state momentum_state wheel_state pointing_state body_state joint_state fleet_state service_status step_timing service_roster
  step_reply run_control_status)
# And those of service/dds/ros2.hpp.
torques=("${torques[@]/#/adstar/}" 'rt/*/torque')
clock=("${clock[@]/#/adstar/}")
standby=("${standby[@]/#/adstar/}")
telemetry=("${telemetry[@]/#/adstar/}" 'rt/*/attitude' 'rt/*/angular_momentum' rt/clock rt/tf)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The extensions are spelled out, so that no openssl.cnf of the machine has a say.
cat > "$work/openssl.cnf" <<'CNF'
[req]
distinguished_name = name
[name]
[authority]
basicConstraints = critical, CA:TRUE, pathlen:0
keyUsage = critical, keyCertSign, cRLSign, digitalSignature
subjectKeyIdentifier = hash
[participant]
basicConstraints = critical, CA:FALSE
keyUsage = critical, digitalSignature
subjectKeyIdentifier = hash
authorityKeyIdentifier = keyid
CNF

quietly() { "$@" 2> "$work/errors" || { cat "$work/errors" >&2; fail "failed: $1 $2"; }; }

make_key() { quietly openssl genpkey -algorithm EC -pkeyopt ec_paramgen_curve:prime256v1 -out "$1"; }

make_authority() {  # directory, which
  make_key "$1/$2_ca.key"
  quietly openssl req -x509 -config "$work/openssl.cnf" -extensions authority -new -sha256 \
    -key "$1/$2_ca.key" -days "$days" -subj "/O=adstar/CN=$2 authority" -out "$1/$2_ca.pem"
}

sign() {  # document, signed document, directory of the authorities
  quietly openssl smime -sign -text -md sha256 -in "$1" -out "$2" -outform smime \
    -signer "$3/permissions_ca.pem" -inkey "$3/permissions_ca.key"
}

# The writer of a command gives its keys to readers of commands only: whoever may merely watch cannot sign in its name.
topic_rule() {  # expression, protection of its messages
  cat <<XML
        <topic_rule>
          <topic_expression>$1</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>$2</metadata_protection_kind>
          <data_protection_kind>NONE</data_protection_kind>
        </topic_rule>
XML
}

governance() {
  cat <<XML
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>230</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>SIGN</liveliness_protection_kind>
      <rtps_protection_kind>SIGN</rtps_protection_kind>
      <topic_access_rules>
$(for topic in "${torques[@]}" "${clock[@]}" "${standby[@]}"; do topic_rule "$topic" SIGN; done)
$(topic_rule '*' NONE)
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
XML
}

criteria() {  # publish or subscribe, topics...
  echo "        <$1>"
  echo "          <topics>"
  printf '            <topic>%s</topic>\n' "${@:2}"
  echo "          </topics>"
  echo "          <partitions><partition>*</partition></partitions>"
  echo "        </$1>"
}

rules() {  # role
  case "$1" in
    daemon) criteria publish "${telemetry[@]}" "${standby[@]}"
      criteria subscribe "${torques[@]}" "${clock[@]}" "${telemetry[@]}" "${standby[@]}" ;;
    operator) criteria publish "${torques[@]}" "${clock[@]}"; criteria subscribe "${torques[@]}" "${clock[@]}" "${telemetry[@]}" ;;
    commander) criteria publish "${torques[@]}"; criteria subscribe "${torques[@]}" "${telemetry[@]}" ;;
    watcher) criteria subscribe "${telemetry[@]}" ;;
  esac
}

permissions() {  # name, role, certificate
  local subject
  subject=$(openssl x509 -in "$3" -noout -subject -nameopt RFC2253)
  cat <<XML
<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="https://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="$1">
      <subject_name>${subject#subject=}</subject_name>
      <validity>
        <not_before>$(date --utc +%Y-%m-%dT%H:%M:%SZ)</not_before>
        <not_after>$(date --utc --date="+$days days" +%Y-%m-%dT%H:%M:%SZ)</not_after>
      </validity>
      <allow_rule>
        <domains><id_range><min>0</min><max>230</max></id_range></domains>
$(rules "$2")
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
XML
}

make_participant() {  # where, name, role, directory of the authorities
  mkdir "$1"
  make_key "$1/private_key.pem"
  quietly openssl req -new -config "$work/openssl.cnf" -key "$1/private_key.pem" -subj "/O=adstar/CN=$2" \
    -out "$work/request"
  quietly openssl x509 -req -sha256 -in "$work/request" -CA "$4/identity_ca.pem" -CAkey "$4/identity_ca.key" \
    -set_serial "0x$(openssl rand -hex 16)" -days "$days" -extfile "$work/openssl.cnf" -extensions participant \
    -out "$1/identity_certificate.pem"
  permissions "$2" "$3" "$1/identity_certificate.pem" > "$work/permissions.xml"
  sign "$work/permissions.xml" "$1/permissions.p7s" "$4"
  cp "$4/identity_ca.pem" "$4/permissions_ca.pem" "$4/governance.p7s" "$1/"
}

if [[ $# -eq 3 ]]; then
  [[ "$2" =~ ^[A-Za-z0-9_][A-Za-z0-9_.-]{0,62}$ && "$2" != authorities ]] ||
    fail "got the name '$2', expected 1 to 63 characters out of A-Z a-z 0-9 _ . -" 2
  [[ "$3" =~ ^(daemon|operator|commander|watcher)$ ]] || usage
  [[ -r "$authorities/identity_ca.key" && -r "$authorities/permissions_ca.key" ]] ||
    fail "$authorities has no authorities; make them first: make.sh $dir"
  [[ ! -e "$dir/$2" ]] || fail "$dir/$2 exists; choose another name, or move it away"
  make_participant "$work/$2" "$2" "$3" "$authorities"
  mv -nT "$work/$2" "$dir/$2"
  echo "made $dir/$2 ($3, $days days)"
  exit 0
fi

[[ ! -e "$dir" ]] || fail "$dir exists; choose another directory, or move it away"
made=$work/made
mkdir -p "$made/authorities"
make_authority "$made/authorities" identity
make_authority "$made/authorities" permissions
governance > "$work/governance.xml"
sign "$work/governance.xml" "$made/authorities/governance.p7s" "$made/authorities"
for role in daemon commander watcher; do
  make_participant "$made/$role" "$role" "$role" "$made/authorities"
done
mkdir -p "$(dirname "$dir")"
mv -nT "$made" "$dir"
echo "made $dir: authorities (keep its keys off line), daemon, commander, watcher ($days days)"
