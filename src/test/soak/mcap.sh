#!/usr/bin/env bash
# Reads exported MCAP files with the reader of PyPI and compares every event with the lines that they were made of.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"

version=1.6.0

usage() {
    cat <<USAGE
Usage: ./furrow soak mcap [OPTION VALUE]…
Exports test missions as MCAP and reads them with mcap of PyPI, which it fetches with pip into a folder that is removed at the end: from
start to end and by their index, all checksums checked. Then the same of the file that every build compares with.

  --version V  Version of the reader. Default: $version.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --version) version=${2-} ;;
        *) fail "mcap knows no option $1. See: ./furrow soak mcap --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak mcap --help"
    shift 2
done
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "--version must be like 1.6.0, not '$version'."
python3 -m venv --help >/dev/null 2>&1 || fail "No Python 3 with venv found, in which the reader runs. Install python3-venv."

run=$(mktemp -d "${TMPDIR:-/tmp}/furrow-mcap.XXXXXX")
logs=$home/target/soak/mcap
trap 'rm -rf "$run"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
rm -rf "$logs"
mkdir -p "$logs" "$run/missions"

say "fetching mcap $version"
python3 -m venv "$run/python"
"$run/python/bin/pip" -q install --disable-pip-version-check "mcap==$version" >"$logs/pip.log" 2>&1 ||
    fail "mcap $version could not be fetched: $logs/pip.log"
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
"$run/python/bin/python" "$soak/parts/compare_mcap.py" "${files[@]}" || fail "mcap: a file differs, or cannot be read"
echo "mcap: passed"
