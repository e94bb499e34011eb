#!/bin/sh
# The expression of the problem matcher against real output: by sed, and by a real JavaScript where there is one.
. "$(dirname -- "$0")/lib.sh"

matcher=$source/tools/ci/github-problem-matcher.json
expression=$("$tool" get "$matcher" problemMatcher/0/pattern/0/regexp)
"$glint" check wrong.glint.yaml warned.glint.yaml --only W401 2>text.txt && fail "an error was expected"
sed -nE "s~$expression~\\1|\\2|\\3|\\4|\\6~p" text.txt >found.txt
cat >wanted.txt <<'S'
wrong.glint.yaml|7|33|error|E206
wrong.glint.yaml|8|46|error|E301
warned.glint.yaml|5|32|warning|W401
S
cmp found.txt wanted.txt || fail "$(cat found.txt)"
command -v node >/dev/null || exit 0
node -e '
const fs = require("fs");
const pattern = JSON.parse(fs.readFileSync(process.argv[1])).problemMatcher[0].pattern[0];
for (const line of fs.readFileSync("text.txt", "utf8").split("\n")) {
  const m = new RegExp(pattern.regexp).exec(line);
  if (m)
    console.log([pattern.file, pattern.line, pattern.column, pattern.severity, pattern.code].map(i => m[i]).join("|"));
}' "$matcher" >node.txt
cmp node.txt wanted.txt || fail "$(cat node.txt)"
