#!/usr/bin/env bash
# Reads exported MCAP files with the reader of PyPI and compares every event with the NDJSON export.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"

version=1.6.0

usage() {
    cat <<USAGE
Usage: ./furrow soak mcap [OPTION VALUE]…
Exports test missions as MCAP and reads them with mcap of PyPI from start to end and by their index, with all checksums verified. Does the
same with the golden file of the build. Fetches the reader with pip into a temporary folder.

  --version V  Version of the reader. Default: $version.
USAGE
}

read_options "version" "$@"
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "--version must be like 1.6.0, not '$version'."
python3 -m venv --help >/dev/null 2>&1 || fail "Python 3 with venv is missing, which runs the reader. Install python3-venv."

prepare
mkdir "$run/missions"

say "fetching mcap $version"
python3 -m venv "$run/python"
"$run/python/bin/pip" -q install --disable-pip-version-check "mcap==$version" >"$logs/pip.log" 2>&1 ||
    fail "Cannot fetch mcap $version: $logs/pip.log"
say "exporting"
(cd "$home" && ./mvnw -B -ntp -pl kit/recordings -am test -Dspotless.check.skip -Dtest=McapExportTest \
    -Dsurefire.failIfNoSpecifiedTests=false "-Dfurrow.mcap.folder=$run/missions") >"$logs/export.log" 2>&1 ||
    fail "The export failed: $logs/export.log"
golden=$home/kit/recordings/src/test/resources/export/mission
files=("$golden.mcap" "$golden.ndjson")
for mission in "$run"/missions/*.mcap; do
    files+=("$mission" "${mission%.mcap}.ndjson")
done
((${#files[@]} >= 10)) || fail "Only $((${#files[@]} / 2)) missions were exported: $logs/export.log"
say "reading"
"$run/python/bin/python" "$soak/parts/compare_mcap.py" "${files[@]}" || fail "a file differs or cannot be read"
echo "mcap: passed"
