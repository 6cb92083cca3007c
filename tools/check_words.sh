#!/usr/bin/env bash
# Finds words and forms that a newcomer cannot understand, in comments, names, help texts and pages.
# usage: tools/check_words.sh [FOLDER]
# Add a line to the list when a reader stumbles; tools/check_words_test.sh tries each of them.
set -euo pipefail
list=$(cat <<'LIST'
[Kk]appa|a name that says what the value is (ortho_offset)
[Ww]hat the contract|the rule itself: what is interpolated, what blocks a ray
(is|are) held to[ ,.]|Regression thresholds; the bound that a test checks
behind the first surface|How thick matter is assumed to be behind each depth sample
[Tt]urns( its| the)? segments|Rotates sectors per pixel
within their width|by a fraction of a sector
whatever they are|Overrides ...
posts and rods|thin objects
what stands behind|objects behind
(not|n.t) know the radius|does not depend on the radius
[Ss]eed of everything|Seed of the random numbers
the processor([^a-z]|$)|the CPU
on the processor|on the CPU
(truth of|against|is not|and of) the world([^'a-z]|$)|the real geometry
(for|to) who([^a-z]|$)|for those who, for users that
lives on|needs
strip_phase|strip_offset (phase is the interleaving of columns and lines)
(direction|[^a-z_]d)(\.|->)phase|strip_offset (phase is the interleaving of columns and lines)
LIST
)
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/..}"
mapfile -t files < <({ git ls-files 2>/dev/null || find . -type f; } |
  grep -E '\.(h|cpp|inc|comp|glsl|md|txt|sh|in|cmake)$|(^|/)run$' |
  grep -vE '(^|/)check_words(_test)?\.sh$|pattern_tables|^build/')
[ "${#files[@]}" -gt 0 ] || files=(/dev/null)
failures=0

report() {
  if [ -n "$2" ]; then
    printf 'words: %s\n%s\n' "$1" "$2" >&2
    failures=$((failures + 1))
  fi
}

while IFS= read -r line; do
  form=${line%|*} better=${line##*|}
  report "say \"$better\"" "$(grep -nHE "$form" "${files[@]}" || true)"
done <<<"$list"

# "Section 10" says nothing without the paper: on the same line, or on one of its neighbours.
report 'name the paper beside the number of its section' "$(awk '
  function check() {
    if (here ~ /(^|[^A-Za-z])[Ss]ections? [0-9]/ && before here after !~ papers)
      print name ":" number ":" here
  }
  BEGIN { papers = "Timonen|Loos|Klehm|Singh|Bavoil|Mittring|Szirmay|notes" }
  FNR == 1 { if (NR > 1) { after = ""; check() } before = ""; here = $0; name = FILENAME; number = 1; next }
  { after = $0; check(); before = here; here = $0; number = FNR }
  END { after = ""; check() }' "${files[@]}")"

# The error figure e_A is spelled out where a page names it first.
for page in "${files[@]}"; do
  [[ $page == *.md ]] || continue
  report 'spell out e_A where it first stands: mean error e_A, mean |difference| in per cent of full scale' "$(awk '
    { lines[FNR] = $0 }
    !first && /(^|[^A-Za-z_])e_A/ { first = FNR }
    END {
      text = lines[first - 1] " " lines[first] " " lines[first + 1]
      if (first && text !~ /mean \|difference\|/) print FILENAME ":" first ":" lines[first]
    }' "$page")"
done

if [ "$failures" -gt 0 ]; then
  exit 1
fi
echo "words: ${#files[@]} files"
