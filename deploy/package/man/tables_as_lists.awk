# Tables of Markdown as lists: a key that is broken to fit its column can be neither searched for nor copied.
# From the third column on, a cell has its heading before it.
function cells(line, into,   n, i) {
  sub(/^\| */, "", line); sub(/ *\|$/, "", line)
  n = split(line, into, / *\| */)
  return n
}
/^\|/ && !table { table = 1; cells($0, head); next }
/^\|[-|]*$/ { next }
/^\|/ {
  n = cells($0, cell)
  text = cell[2]
  for (i = 3; i <= n; ++i) {
    if (cell[i] ~ /^required/) text = text " (" cell[i] ")"
    else if (cell[i] != "-") text = text " (" head[i] ": " cell[i] ")"
  }
  printf "\n%s\n: %s\n", cell[1], text
  next
}
{ table = 0; print }
