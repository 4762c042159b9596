# Sourced by tests that are scripts: what a page has its reader type.

# typed PAGE SECTION [PATTERN]: the indented lines of a section, those that match, without their comments.
typed() {
  sed -n "/^##* $2\$/,/^#/s/^    //p" "$1" | sed 's/  *#.*//' | grep -E -- "${3:-.}" || fail "$1 has nothing to type in '$2'${3:+ that matches $3}"
}
