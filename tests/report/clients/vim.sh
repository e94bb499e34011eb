#!/bin/sh
# The errorformat of docs/ci.md in Vim.
. "$(dirname -- "$0")/lib.sh"
needs vim
vim --version | grep -q '+quickfix' || skip "this vim has no quickfix list"

grep '^set errorformat=' "$source/docs/ci.md" >format.vim
[ -s format.vim ] || fail "docs/ci.md has no errorformat"
"$glint" check wrong.glint.yaml warned.glint.yaml --only W401 2>text.txt && fail "an error was expected"
cat >>format.vim <<'S'
cgetfile text.txt
let found = []
for e in getqflist()
  if e.valid
    call add(found, bufname(e.bufnr) . '|' . e.lnum . '|' . e.col . '|' . e.type . '|' . matchstr(e.text, '\[\zs[EWN]\d\+\ze\]$'))
  endif
endfor
call writefile(found, 'found.txt')
qall!
S
TERM=dumb vim -N -u NONE -i NONE -n -es -S format.vim </dev/null || true
cat >wanted.txt <<'S'
wrong.glint.yaml|7|33|e|E206
wrong.glint.yaml|8|46|e|E301
warned.glint.yaml|5|32|w|W401
S
# The notes of a finding are entries of their own.
grep -v '|n|' found.txt >places.txt
cmp places.txt wanted.txt || fail "$(cat found.txt)"
grep -q '^open.obj|4|1|n|$' found.txt || fail "the note in the mesh is no entry"
