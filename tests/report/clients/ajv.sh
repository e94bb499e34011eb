#!/bin/sh
# ajv, another reader of our schemas, on the same reports.
. "$(dirname -- "$0")/lib.sh"
needs ajv

cd "$source"
# shellcheck disable=SC2046 -- our paths hold no blanks
for format in json sarif gitlab; do
    "$glint" check $(ls -d tests/invalid/*/case.yaml tests/invalid/*/case.xml) --format $format -o "$work/report.$format.json" ||
        true
done
cd "$work"
schemas="json:$source/docs/schema/check-report.schema.json sarif:$source/tests/report/sarif.schema.json
gitlab:$source/tests/report/gitlab.schema.json"
for pair in $schemas; do
    ajv validate --spec=draft7 -s "${pair#*:}" -d "report.${pair%%:*}.json" >ajv.txt 2>&1 || fail "$(head -20 ajv.txt)"
    # And it can refuse.
    sed 's/"column"/"colum"/; s/"ruleId"/"rulId"/; s/"check_name"/"checkname"/' "report.${pair%%:*}.json" >broken.json
    if ajv validate --spec=draft7 -s "${pair#*:}" -d broken.json >ajv.txt 2>&1; then
        fail "a broken report is valid: ${pair%%:*}"
    fi
done
