# What lowdown writes, in the words of man(7) that every formatter knows.
{ gsub(/\\fC/, "\\fB"); line[NR] = $0 }

function is_term(i) { return line[i] == ".LP" && line[i + 2] == ".if n \\" }  # and what follows is drawn up to it

END {
  for (i = 2; i <= NR; ++i) {  # the first is an editor's
    if (line[i] == ".SH") {
      print ".SH " toupper(line[++i])
      if (line[i + 1] ~ /^\.[LP]P$/ && !is_term(i + 1)) ++i
    } else if (is_term(i)) {
      print ".TP\n" line[i + 1]
      i += 6
    } else {
      print (line[i] == ".LP" ? ".PP" : line[i])
    }
  }
}
