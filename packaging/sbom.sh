#!/bin/sh
# What a package is made of, as SPDX 2.3 in JSON, to standard output: packaging/sbom.sh NAME VERSION PROGRAM. Libraries are those that
# the program loads, or that it says it was built with where it is static, with the versions of Debian's packages.
set -eu
name=$1
version=$2
program=$3
created=$(date -u -d "@${SOURCE_DATE_EPOCH:?the time of the release}" +%Y-%m-%dT%H:%M:%SZ)
sum=$(sha256sum "$program" | cut -d' ' -f1)
packages="libbrotli1 libc6 libexpat1 libfreetype6 libjansson4 libjpeg62-turbo libminizip1 libpng16-16 libxxhash-dev libyaml-0-2 zlib1g"

cat <<END
{
  "spdxVersion": "SPDX-2.3",
  "dataLicense": "CC0-1.0",
  "SPDXID": "SPDXRef-DOCUMENT",
  "name": "$name-$version",
  "documentNamespace": "https://example.com/glint/spdx/$name-$version-$sum",
  "creationInfo": {"created": "$created", "creators": ["Organization: the glint authors", "Tool: packaging/sbom.sh"]},
  "documentDescribes": ["SPDXRef-glint"],
  "packages": [
    {"SPDXID": "SPDXRef-glint", "name": "$name", "versionInfo": "$version", "downloadLocation": "NOASSERTION",
     "filesAnalyzed": false, "licenseConcluded": "MIT", "licenseDeclared": "MIT",
     "copyrightText": "Copyright (c) 2026 the glint authors", "checksums": [{"algorithm": "SHA256", "checksumValue": "$sum"}]}
END
relations=
for package in $packages; do
    found=$(dpkg-query -W -f '${Version} ${source:Package}' "$package" 2>/dev/null) || continue
    printf '    ,{"SPDXID": "SPDXRef-%s", "name": "%s", "versionInfo": "%s", "sourceInfo": "Debian source package %s",\n' \
        "$package" "$package" "${found%% *}" "${found##* }"
    printf '     "downloadLocation": "NOASSERTION", "filesAnalyzed": false, "licenseConcluded": "NOASSERTION",\n'
    printf '     "licenseDeclared": "NOASSERTION", "copyrightText": "NOASSERTION",\n'
    printf '     "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",\n'
    printf '       "referenceLocator": "pkg:deb/debian/%s@%s"}]}\n' "$package" "${found%% *}"
    relations="$relations$package "
done
printf '  ],\n  "relationships": [\n    {"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", '
printf '"relatedSpdxElement": "SPDXRef-glint"}\n'
kind=DYNAMIC_LINK
file -L "$program" | grep -q 'static' && kind=STATIC_LINK
for package in $relations; do
    printf '    ,{"spdxElementId": "SPDXRef-glint", "relationshipType": "%s", "relatedSpdxElement": "SPDXRef-%s"}\n' \
        "$kind" "$package"
done
printf '  ]\n}\n'
