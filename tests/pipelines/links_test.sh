#!/usr/bin/env bash
# Every relative link of every page leads to a file of the repository, and every test that docs/accuracy.md names exists.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 1
failures=0
pages=0
while IFS= read -r page; do
  pages=$((pages + 1))
  while IFS= read -r link; do
    case $link in http://* | https://* | '#'*) continue ;; esac
    if [ ! -e "$(dirname "$page")/${link%%#*}" ]; then
      echo "FAILED: $page links to $link"
      failures=$((failures + 1))
    fi
  done < <(grep -oE '\]\([^) ]+\)' "$page" | sed 's/^](//; s/)$//')
done < <(find . -name '*.md' -not -path './build/*' -not -path './out/*' -not -path './data/*')
if [ "$pages" -lt 10 ]; then
  echo "FAILED: only $pages pages found"
  failures=$((failures + 1))
fi

tests=0
while IFS= read -r name; do
  tests=$((tests + 1))
  if ! grep -rqw "$name" --include='*_test.cpp' tests; then
    echo "FAILED: docs/accuracy.md names a test $name, which does not exist"
    failures=$((failures + 1))
  fi
done < <(grep -oE '\b[A-Z][A-Za-z]+[a-z][A-Z][A-Za-z]{14,}\b' docs/accuracy.md | sort -u)
if [ "$tests" -lt 20 ]; then
  echo "FAILED: docs/accuracy.md names only $tests tests"
  failures=$((failures + 1))
fi
exit $((failures > 0))
